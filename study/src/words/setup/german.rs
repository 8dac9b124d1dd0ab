//! In German.

use scumble_psychophysics::{Consent, Demographics, Display, Task};

use super::{SetupWords, told};
use crate::session_folder::Found;
use crate::setup::{ConsentProblem, Effort, FolderProblem, MeasuredDisplay, Page, Problem, SRGB_LEVEL};
use crate::setup::{gamma, is_near_srgb};

pub(in crate::words) const GERMAN: SetupWords = SetupWords {
    title,
    progress: |number, count| format!("{number} von {count}"),
    keys,
    back: "Zurück",
    next: "Weiter",
    problem,
    folder_problem,

    folder: "Ordner der Studie",
    folder_hint: "Pfad eingeben oder den Ordner hierher ziehen",
    recent: "Frühere Studien",
    protocol: "Protokoll",
    task: |task| match task {
        Task::TwoAlternative => "Immer zwei Bilder: Welches war die Linie?",
        Task::YesNo => "Immer ein Bild: War das ursprüngliche Bild eine Linie?",
    },
    effort,
    protocol_first: "Nennen Sie zuerst den Ordner der Studie: Vielleicht liegt dort schon ein Protokoll.",
    protocol_new: "In diesem Ordner ist noch keine Studie: Eine neue beginnt, mit einer Kopie dieses Protokolls für \
                   alle weiteren Personen.",
    protocol_kept: "Aus protocol.toml im Ordner der Studie, für alle Personen dasselbe.",
    language: "Sprache",
    participant: "Code der Person",
    participant_hint: "zum Beispiel p07",
    participant_note: "Ein Code, nie ein Name: 1 bis 16 Buchstaben, Ziffern, - und _.",
    participant_value: |code, number| match number {
        Some(number) => format!("{code}, Nummer {number}"),
        None => code.to_owned(),
    },
    number: "Nummer für die Reihenfolge der Runden",
    monitor: "Bildschirm",
    monitor_named,
    elsewhere: "Fenster",
    elsewhere_value: |found| {
        format!(
            "ist auf einem anderen: {}. Gehen Sie zur ersten Seite zurück und wählen Sie neu.",
            monitor_named(found)
        )
    },
    interrupted: "Diese Sitzung",
    resume: "Fortsetzen",
    repeat_round: "Runde wiederholen",
    discard: "Verwerfen",

    distance: "Sehabstand",
    distance_text: "Abstand der Augen vom Bildschirm:",
    card: "Umriss einer Karte",
    card_text: "Halten Sie eine Bankkarte oder eine andere Karte dieser Größe (85,6 x 54 mm) flach an den Bildschirm, \
                ihren linken Rand auf dem des Umrisses. Machen Sie den Umriss so breit wie die Karte: mit den \
                Pfeiltasten, fein mit der Umschalttaste, oder durch Ziehen; drücken Sie dann die Eingabetaste. Passt er \
                von Anfang an, wählen Sie \u{201e}Passt\u{201c}.",
    card_matches: "Passt",
    not_measured: "Nicht gemessen",
    pixel_size: "Bildpunkte je mm",
    pixel_angle: "Bildpunkte je Grad",
    texels: "Texel",
    distance_value: |mm| match mm {
        Some(mm) => comma(format!("{:.1} cm", mm / 10.0)),
        None => "nicht gemessen".to_owned(),
    },
    pixel_size_value: |px_per_mm| {
        px_per_mm.map_or_else(|| "nicht gemessen".to_owned(), |value| comma(format!("{value:.2}")))
    },
    pixel_angle_value: |value| match value {
        Some(value) => comma(format!("{value:.1}")),
        None => "unbekannt, ohne Abstand und Größe".to_owned(),
    },
    texels_value: |sizes| {
        let of = |(px, arcmin): &(f64, f64)| comma(format!("{px}\u{a0}px\u{a0}=\u{a0}{arcmin:.1}'"));
        format!("{} (Bogenminuten)", sizes.iter().map(of).collect::<Vec<_>>().join(";  "))
    },

    brightness: "Helligkeit",
    gamma_text: "Treten Sie zwei Meter zurück oder kneifen Sie die Augen zusammen, bis die Zeilen links zu einem Grau \
                 verschwimmen. Ändern Sie das Grau rechts mit den Pfeiltasten, fein mit der Umschalttaste, bis beide \
                 Felder gleich aussehen; drücken Sie dann die Eingabetaste.",
    grey: "Grau",
    gamma_alike: "Sie sehen gleich aus",
    not_checked: "Nicht geprüft",
    gamma_result,
    table_text: |rows| {
        format!(
            "Der Bildschirm ist gemessen: luminance.csv im Ordner der Studie enthält {}. Die Bilder werden für diese \
             Kurve gezeichnet; hier ist nichts einzustellen.\n\nDie Linie ist die Leuchtdichte jeder Graustufe, ein Punkt ist \
             eine Messung. Die breite Linie ist sRGB, zum Vergleich.",
            range(rows)
        )
    },
    luminance: |value| comma(format!("{value} cd/m\u{b2}")),
    brightness_value,

    room: "Raum",
    room_text: "Beschreiben Sie das Licht im Raum, so dass jemand anders es wieder so einrichten könnte.",
    room_hint: "Zum Beispiel: Deckenlampen aus, Schreibtischlampe hinter dem Bildschirm an, Jalousien geschlossen; vom \
                Platz der Person aus keine Spiegelungen; Bildschirm seit einer halben Stunde an.",
    room_note: "Wird mit der Sitzung aufbewahrt. Lassen Sie das Feld leer, wenn es nichts zu sagen gibt.",
    room_next: "Die nächsten Seiten sind für die Versuchsperson: Bitte übergeben Sie ihr die Tastatur.",
    room_value: |note| note.map_or_else(|| "keine Notiz".to_owned(), |note| note.replace('\n', " ")),
    hand_over: "An die Versuchsperson übergeben",

    consent: "Einwilligung",
    consent_text: "Bitte lesen Sie diesen Text, und fragen Sie alles, was Sie wissen möchten.",
    has_agreed: "Sie haben diesem Text zugestimmt.",
    agree: "Ich stimme zu",
    disagree: "Ich stimme nicht zu",
    consent_value: |consent| match consent {
        Some(Consent { text_sha256, agreed_at }) => {
            let fingerprint: String = text_sha256.chars().take(12).collect();
            format!("zugestimmt am {}, Text {fingerprint}...", agreed_at.strftime("%d.%m.%Y um %H:%M UTC"))
        }
        None => "nicht gefragt: Die Studie hat keinen Einwilligungstext".to_owned(),
    },
    declined: "Das ist in Ordnung. Es wurde nichts aufgezeichnet, und es wird nichts aufgezeichnet. Vielen Dank, dass \
               Sie gekommen sind.",
    close: "Programm schließen",

    about: "Über Sie",
    about_text: "Sie können jede dieser Fragen unbeantwortet lassen.",
    age: "Alter in Jahren",
    gender: "Geschlecht",
    genders: ["weiblich", "männlich", "divers"],
    hand: "Schreibhand",
    hands: ["links", "rechts", "beide"],
    vision: "Sehvermögen heute",
    visions: ["normal", "mit Brille oder Linsen", "eingeschränkt"],
    experience: "Computergrafik",
    experiences: ["keine Erfahrung", "etwas", "vom Fach"],
    no_answer: "keine Angabe",
    about_value,

    summary_text: "Das wird aufgezeichnet, wenn Sie beginnen:",
    summary_each_trial: "Und zu jedem Durchgang: die Bilder, die Antwort und wie lange sie gedauert hat.",
    unfinished: |page| format!("Auf der Seite \u{201e}{}\u{201c} fehlt etwas.", title(page)),
    start: "Beginnen",
};

fn title(page: Page) -> &'static str {
    match page {
        Page::Study => "Studie",
        Page::Screen => "Bildschirm",
        Page::Brightness => "Helligkeit",
        Page::Room => "Raum",
        Page::Consent => "Einwilligung",
        Page::Declined => "Vielen Dank",
        Page::About => "Über Sie",
        Page::Summary => "Zusammenfassung",
    }
}

fn keys(page: Page) -> &'static str {
    match page {
        Page::Study => "Eingabe: weiter      Tab: nächstes Feld",
        Page::Room => "Tab: Text verlassen      Eingabe: neue Zeile      Escape: zurück",
        Page::Consent => "Bild- und Pfeiltasten: Text blättern      Tab, Eingabe: auswählen      Escape: zurück",
        Page::Declined => "Tab, Eingabe: auswählen      Escape: zurück",
        Page::Summary => "Eingabe: beginnen      Escape: zurück",
        _ => "Eingabe: weiter      Tab: nächstes Feld      Escape: zurück",
    }
}

fn problem(problem: &Problem<'_>) -> String {
    match problem {
        Problem::NoFolder => {
            "Welche Studie ist es? Ein Ordner, den es noch nicht gibt, wird eine neue Studie.".to_owned()
        }
        Problem::Folder(problem) => folder_problem(problem),
        Problem::Consent(ConsentProblem::OtherLanguage { found, missing }) => format!(
            "Der Einwilligungstext liegt nur in der anderen Sprache vor, {}. Legen Sie {missing} dazu, oder wählen Sie \
             die andere Sprache.",
            found.display()
        ),
        Problem::Consent(ConsentProblem::Unreadable { file, reason }) => {
            // The readers of files speak English, here and below: what to do comes first.
            format!(
                "Der Einwilligungstext lässt sich nicht lesen: Speichern Sie ihn als Text in UTF-8. Meldung: {}: {reason}",
                file.display()
            )
        }
        Problem::Luminance(problem) => format!(
            "Die Messung des Bildschirms lässt sich nicht lesen: Verbessern Sie die genannte Zeile, oder nehmen Sie \
             luminance.csv aus dem Ordner. Meldung: {problem}"
        ),
        Problem::NoCode => "Wer nimmt teil? Geben Sie den Code der Person ein.".to_owned(),
        Problem::NotACode(code) => format!(
            "\u{201e}{code}\u{201c} ist kein Code. Erlaubt sind 1 bis 16 Buchstaben (a bis z), Ziffern, - und _, aber kein Name."
        ),
        Problem::NotANumber(number) => {
            format!("\u{201e}{number}\u{201c} ist keine Nummer. Erlaubt ist 0, 1, 2 und so weiter, oder nichts.")
        }
        Problem::Session(found) => session(found),
        Problem::Damaged(error) => {
            format!("Unter diesem Code gibt es eine Sitzung, die sich nicht lesen lässt: {error}")
        }
        Problem::NotADistance(typed) => {
            format!("\u{201e}{typed}\u{201c} ist kein Abstand. Erlaubt sind 20 bis 500 cm, oder nichts.")
        }
        Problem::NoConsent => "Die Person hat nicht zugestimmt.".to_owned(),
        Problem::NotAnAge(typed) => {
            format!("\u{201e}{typed}\u{201c} ist kein Alter. Erlaubt sind 5 bis 120 Jahre, oder nichts.")
        }
    }
}

fn session(found: &Found) -> String {
    match found {
        Found::Free(_) => String::new(),
        Found::Complete(_) => {
            "Unter diesem Code gibt es eine abgeschlossene Sitzung. Geben Sie einen anderen Code ein.".to_owned()
        }
        Found::Interrupted(session) => format!(
            "Unter diesem Code gibt es eine Sitzung, die vor {} unterbrochen wurde: {} von höchstens {} \
             Durchgängen sind beantwortet.",
            age(session.age_secs),
            session.trials,
            session.trials_at_most
        ),
    }
}

/// See the English one; the dative follows "vor".
fn age(secs: f64) -> String {
    let units = [(86_400.0, "Tagen"), (3600.0, "Stunden"), (60.0, "Minuten")];
    let unit = units.into_iter().find(|(length, _)| secs >= 2.0 * length);
    unit.map_or_else(|| "einem Moment".to_owned(), |(length, name)| format!("{:.0} {name}", secs / length))
}

fn folder_problem(problem: &FolderProblem) -> String {
    match problem {
        FolderProblem::NotAFolder(path) => format!("{} ist eine Datei; erlaubt ist ein Ordner", path.display()),
        FolderProblem::NotWritable { path, reason } => {
            format!(
                "{}: darin lässt sich nicht schreiben ({reason}); erlaubt ist ein beschreibbarer Ordner",
                path.display()
            )
        }
        FolderProblem::Protocol(error) => format!(
            "Das Protokoll lässt sich nicht verwenden: Verbessern Sie die genannte Stelle der Datei, oder nehmen Sie ein \
             anderes. Meldung: {error}"
        ),
        FolderProblem::Differs { file, name, asked, asked_name } => format!(
            "Die Studie hat das Protokoll \u{201e}{name}\u{201c} ({}), --protocol {asked} ist \u{201e}{asked_name}\u{201c} mit anderen \
             Parametern. Lassen Sie --protocol weg, um mit dem der Studie weiterzumachen, oder wählen Sie für eine neue \
             Studie einen anderen Ordner.",
            file.display()
        ),
    }
}

fn effort(effort: &Effort) -> String {
    let Effort { rounds, staircases, trials, minutes } = effort;
    format!(
        "{rounds} Runden mit je {staircases} Treppenverfahren: etwa {trials} Durchgänge, {minutes:.0} Minuten und die Pausen."
    )
}

fn monitor_named(display: &Display) -> String {
    let Display { width_px, height_px, .. } = display;
    let name = display.monitor.as_deref().unwrap_or("ohne Namen");
    let refresh = display.refresh_hz.map_or_else(String::new, |hz| format!(", {hz:.0} Hz"));
    format!("{name}: {width_px} x {height_px}, Skalierung {}{refresh}", comma(display.scale_factor.to_string()))
}

fn gamma_result(level: Option<u8>) -> String {
    let Some(level) = level else {
        return "Solange niemand geprüft hat, gilt der Bildschirm als sRGB.".to_owned();
    };
    let found = format!("Stufe {level}: ein Gamma von {}.", comma(format!("{:.2}", gamma(level))));
    if is_near_srgb(level) {
        return format!("{found} Das liegt nahe bei sRGB (Stufe {SRGB_LEVEL}), von dem die Bilder ausgehen.");
    }
    format!(
        "{found} Das ist nicht sRGB (Stufe {SRGB_LEVEL}), von dem die Bilder ausgehen. Stellen Sie am Bildschirm das Gamma \
         auf 2,2 oder den Bildmodus auf sRGB, schalten Sie Nachtmodus und dynamischen Kontrast aus, wählen Sie seine \
         eigene Auflösung, und prüfen Sie noch einmal; oder messen Sie ihn mit einem Photometer und legen Sie \
         luminance.csv in den Ordner der Studie."
    )
}

fn range(rows: &[(u8, f64)]) -> String {
    let [black, white] = [rows.first(), rows.last()].map(|row| row.map_or(0.0, |row| row.1));
    comma(format!("{} Stufen von {black} bis {white} cd/m\u{b2}", rows.len()))
}

fn brightness_value(measured: &MeasuredDisplay) -> String {
    match (&measured.luminance_table, measured.gamma_check_level) {
        (Some(rows), _) => format!("gemessen: {}", range(rows)),
        (None, Some(level)) if is_near_srgb(level) => {
            comma(format!("nahe bei sRGB: Gamma {:.2} (Stufe {level})", gamma(level)))
        }
        (None, Some(level)) => comma(format!("nicht sRGB: Gamma {:.2} (Stufe {level})", gamma(level))),
        (None, None) => "nicht geprüft; gilt als sRGB".to_owned(),
    }
}

fn about_value(told_about: Option<&Demographics>) -> String {
    let Some(Demographics { age_years, gender, handedness, vision, graphics_experience }) = told_about else {
        return "keine Angaben".to_owned();
    };
    let answers = [
        age_years.map(|years| format!("{years} Jahre")),
        told(GERMAN.genders, gender.map(|gender| gender as usize)).map(str::to_owned),
        told(GERMAN.hands, handedness.map(|hand| hand as usize)).map(|hand| format!("schreibt: {hand}")),
        told(GERMAN.visions, vision.map(|vision| vision as usize)).map(|vision| format!("sieht: {vision}")),
        told(GERMAN.experiences, graphics_experience.map(|experience| experience as usize))
            .map(|experience| format!("Grafik: {experience}")),
    ];
    answers.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Numbers as they are written in German.
fn comma(number: String) -> String {
    number.replace('.', ",")
}
