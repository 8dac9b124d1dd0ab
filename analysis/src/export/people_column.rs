//! The columns of `participants.tsv`, a row a person, and of the `scans.tsv` files, a row a session.

use std::collections::BTreeSet;

use scumble_psychophysics::{Demographics, Display, Handedness};

use super::exported_session::{ExportedSession, Status};
use crate::column::{Cell, Column, Levels, YES_NO, flag, number, word};
use crate::load::directory_name;

/// A column of people.
type PersonColumn<'a> = Column<Participant<'a>>;

/// A column of sessions.
type SessionColumn<'a> = Column<&'a ExportedSession>;

/// BIDS asks that nobody older than this can be told by the age.
const AGE_LARGEST_YEARS: u32 = 89;

const GENDERS: Levels = &[("female", "female"), ("male", "male"), ("other", "other")];

/// BIDS' words.
const HANDEDNESSES: Levels = &[("left", "left-handed"), ("right", "right-handed"), ("ambidextrous", "both")];

const VISIONS: Levels = &[
    ("normal", "normal without a correction"),
    ("corrected", "corrected to normal, by glasses or lenses that were worn"),
    ("impaired", "below normal"),
];

const EXPERIENCES: Levels = &[("none", "none"), ("some", "some"), ("expert", "expert in computer graphics")];

const STATUSES: Levels = &[
    ("complete", "ended after the last trial"),
    ("stopped", "ended early by the administrator"),
    ("unfinished", "interrupted and not resumed"),
];

/// A person with all sessions, in the order of time.
pub(super) struct Participant<'a> {
    /// At least one.
    pub(super) sessions: Vec<&'a ExportedSession>,
}

impl Participant<'_> {
    /// What the first session that knows it says.
    fn first<T>(&self, of: impl Fn(&ExportedSession) -> Option<T>) -> Option<T> {
        self.sessions.iter().find_map(|session| of(session))
    }

    /// What the participant said of themselves first.
    fn said<T>(&self, of: impl Fn(&Demographics) -> Option<T>) -> Option<T> {
        self.first(|session| of(session.demographics()?))
    }

    /// What all sessions agree on.
    fn common(&self, of: impl Fn(&ExportedSession) -> Cell) -> Cell {
        let found: BTreeSet<Cell> = self.sessions.iter().map(|session| of(session)).collect();
        if found.len() == 1 { found.into_iter().next().flatten() } else { None }
    }

    /// The first session's that is not complete.
    fn status(&self) -> Status {
        let open = self.sessions.iter().map(|session| session.status()).find(|status| *status != Status::Complete);
        open.unwrap_or(Status::Complete)
    }
}

/// The columns of `participants.tsv`.
pub(super) fn participant_columns<'a>() -> Vec<PersonColumn<'a>> {
    let code = "The code under which the participant took part. participant_id is this code without other characters \
                than letters and digits; where two codes would share one, the later code's has x2, x3, … at its end.";
    vec![
        PersonColumn::new("participant_id", "Participant", "The name of the participant's folder.", |row| {
            row.first(|session| Some(format!("sub-{}", session.participant_label)))
        }),
        PersonColumn::new("participant_code", "Participant's code", code, |row| {
            row.first(|session| Some(session.session().header.participant.clone()))
        }),
        PersonColumn::new("age", "Age", "As stated; 89 stands for 89 and more.", |row| {
            Some(row.said(|person| person.age_years)?.min(AGE_LARGEST_YEARS).to_string())
        })
        .in_units("year"),
        PersonColumn::new("gender", "Gender", "As stated.", |row| word(row.said(|person| person.gender)?))
            .of_levels(GENDERS),
        PersonColumn::new("handedness", "Handedness", "The hand that writes, as stated.", |row| {
            Some(handedness(row.said(|person| person.handedness)?).to_owned())
        })
        .of_levels(HANDEDNESSES),
        PersonColumn::new("vision", "Vision", "During the session, as stated.", |row| {
            word(row.said(|person| person.vision)?)
        })
        .of_levels(VISIONS),
        PersonColumn::new("graphics_experience", "Experience with computer graphics", "As stated.", |row| {
            word(row.said(|person| person.graphics_experience)?)
        })
        .of_levels(EXPERIENCES),
        PersonColumn::new("simulated", "Simulated", "Whether a simulated observer answered, not a person.", |row| {
            row.common(|session| flag(session.session().header.simulated_observer.is_some()))
        })
        .of_levels(YES_NO),
        PersonColumn::new("sessions", "Sessions", "Number of sessions in this dataset.", |row| {
            Some(row.sessions.len().to_string())
        }),
        PersonColumn::new("status", "Status", "complete, or the status of the first session that is not.", |row| {
            Some(row.status().name().to_owned())
        })
        .of_levels(STATUSES),
        PersonColumn::new(
            "standing_trials",
            "Standing trials",
            "Measured trials whose answers count, all sessions.",
            |row| Some(row.sessions.iter().map(|session| session.standing_trials()).sum::<usize>().to_string()),
        ),
        PersonColumn::new("px_per_degree", "Pixels per degree", "Of visual angle; n/a where sessions differ.", |row| {
            row.common(px_per_degree)
        })
        .in_units("px/deg"),
    ]
}

/// The columns of a `scans.tsv`.
pub(super) fn session_columns<'a>() -> Vec<SessionColumn<'a>> {
    let mut columns = course();
    columns.extend(place());
    columns.extend(origin());
    columns
}

/// What happened in the session.
fn course<'a>() -> Vec<SessionColumn<'a>> {
    vec![
        SessionColumn::new("filename", "File", "The events of the session.", |row| Some(row.events_file())),
        SessionColumn::new("acq_time", "Beginning", "When the session began, UTC.", |row| {
            Some(row.session().header.started_at.strftime("%Y-%m-%dT%H:%M:%S%.6fZ").to_string())
        }),
        SessionColumn::new("status", "Status", "How the session ended.", |row| Some(row.status().name().to_owned()))
            .of_levels(STATUSES),
        SessionColumn::new("answers", "Answers", "All of them, with practice and repeated rounds.", |row| {
            Some(row.answers().to_string())
        }),
        SessionColumn::new("standing_trials", "Standing trials", "Measured trials whose answers count.", |row| {
            Some(row.standing_trials().to_string())
        }),
        SessionColumn::new(
            "missed_frames",
            "Missed frames",
            "Display refreshes by which pictures came late, all trials.",
            |row| Some(row.missed_frames().to_string()),
        ),
    ]
}

/// Where and on what it happened.
fn place<'a>() -> Vec<SessionColumn<'a>> {
    vec![
        SessionColumn::new("language", "Language", "Of the screens.", |row| word(row.session().header.language?))
            .of_levels(&[("en", "English"), ("de", "German")]),
        SessionColumn::new("room", "Room", "The administrator's note on light and surroundings.", |row| {
            row.session().header.room.clone()
        }),
        SessionColumn::new("monitor", "Monitor", "Its name.", |row| display(row)?.monitor.clone()),
        SessionColumn::new("scale_factor", "Scale factor", "Physical pixels per logical point.", |row| {
            number(display(row)?.scale_factor)
        })
        .in_units("px"),
        SessionColumn::new(
            "px_per_degree",
            "Pixels per degree",
            "Of visual angle at the participant's distance.",
            |row| px_per_degree(row),
        )
        .in_units("px/deg"),
        SessionColumn::new(
            "luminance_measured",
            "Light measured",
            "Whether pictures follow a measured table.",
            |row| flag(display(row)?.luminance_table.is_some()),
        )
        .of_levels(YES_NO),
        SessionColumn::new(
            "gamma_check_level",
            "Gamma check",
            "Grey level matched to a half-lit pattern, 0 to 255.",
            |row| Some(display(row)?.gamma_check_level?.to_string()),
        ),
        SessionColumn::new("consent_agreed_at", "Consent", "When the participant agreed to the text, UTC.", |row| {
            Some(row.session().header.consent.as_ref()?.agreed_at.to_string())
        }),
        SessionColumn::new("consent_text_sha256", "Text of the consent", "Its SHA-256.", |row| {
            Some(row.session().header.consent.as_ref()?.text_sha256.clone())
        }),
    ]
}

/// What the session follows from, and where it comes from.
fn origin<'a>() -> Vec<SessionColumn<'a>> {
    vec![
        SessionColumn::new("protocol", "Protocol", "Its name; all its parameters are in session.json.", |row| {
            Some(row.session().header.protocol.name.clone())
        }),
        SessionColumn::new(
            "participant_number",
            "Participant's number",
            "Where a Latin square of rounds is read.",
            |row| Some(row.session().header.participant_number.to_string()),
        ),
        SessionColumn::new("seed", "Seed", "Every draw of the session follows from it.", |row| {
            Some(row.session().header.seed.to_string())
        }),
        SessionColumn::new("simulated_observer", "Simulated observer", "Its kind; n/a for a person.", |row| {
            Some(row.session().header.simulated_observer?.name().to_owned())
        }),
        SessionColumn::new("record", "Record", "Name of the folder that the session was recorded in.", |row| {
            Some(directory_name(&row.session().directory))
        }),
        SessionColumn::new(
            "record_sha256",
            "Hash of the record",
            "SHA-256 of session.json followed by events.jsonl.",
            |row| Some(row.loaded.sha256.clone()),
        ),
    ]
}

fn display(session: &ExportedSession) -> Option<&Display> {
    session.session().header.display.as_ref()
}

fn px_per_degree(session: &ExportedSession) -> Cell {
    number(display(session)?.px_per_degree?)
}

fn handedness(handedness: Handedness) -> &'static str {
    match handedness {
        Handedness::Left => "left",
        Handedness::Right => "right",
        Handedness::Both => "ambidextrous",
    }
}
