//! A participant at the window, and the state machine that knows what the window must show.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

use image::GrayImage;
use scumble_psychophysics::{
    Answer, EVENTS_FILE, Event, Experiment, Protocol, Reply, Role, Session, Stage, Trial, read_session,
};
use scumble_stimuli::{Transfer, picture_sha256};

use crate::pixels::Pixels;
use crate::programs::{Running, wait_for};
use crate::screen::Screen;

/// The code of the participant.
const PARTICIPANT: &str = "someone-3";
/// The number of the participant, which stands at the end of the code.
pub const PARTICIPANT_NUMBER: u32 = 3;

/// A session in the window, from its first screen to its last.
pub struct Sitting<'a> {
    screen: &'a Screen,
    protocol: Protocol,
    session: PathBuf,
    /// Names the session on the command line.
    common: Vec<String>,
    environment: Vec<(&'a str, &'a str)>,
    pub study: Running,
    expected: Experiment,
    given: Vec<(Trial, Answer)>,
    /// Lines of the record without an answer.
    moments: usize,
}

/// A shipped protocol cut short: one texel, one contrast, one trial a staircase, one to practise.
pub fn short(name: &str) -> Protocol {
    let mut protocol = Protocol::named(name).unwrap();
    protocol.name = format!("short {name}");
    protocol.conditions.contrasts = vec![0.5];
    protocol.conditions.texels_px = vec![10.0];
    protocol.schedule.trials_min = 1;
    protocol.schedule.trials_max = 1;
    protocol.practice.ratios = vec![1.0];
    protocol
}

/// The roles of a session, in order.
pub fn roles(protocol: &Protocol, seed: u64) -> Vec<Role> {
    let mut experiment = Experiment::new(protocol.clone(), seed, PARTICIPANT_NUMBER).unwrap();
    let mut roles = Vec::new();
    while let Some(trial) = next_trial(&mut experiment) {
        roles.push(trial.role);
        experiment.answer(reply(trial.pictures.right_answer())).unwrap();
    }
    roles
}

impl<'a> Sitting<'a> {
    /// Opens the window on a protocol file in `folder`, where the session goes as well.
    pub fn start(
        screen: &'a Screen,
        folder: &Path,
        protocol: Protocol,
        seed: u64,
        environment: &[(&'a str, &'a str)],
    ) -> Self {
        Self::start_with(screen, folder, protocol, seed, environment, &["--quick-start"])
    }

    /// Opens the window with the set-up pages before the session, for a person whose home is `folder`.
    pub fn set_up(screen: &'a Screen, folder: &'a Path, protocol: Protocol, seed: u64) -> Self {
        // The folders of former studies are remembered below these.
        let home = ["HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"].map(|name| (name, folder.to_str().unwrap()));
        Self::start_with(screen, folder, protocol, seed, &home, &[])
    }

    /// Lets a simulated person sit through a session by itself, and gives its record.
    pub fn rehearse(screen: &Screen, folder: &Path, protocol: Protocol, seed: u64, observer: &str) -> Session {
        let arguments = ["--quick-start", "--rehearse", observer, "--speed", "20"];
        let mut sitting = Sitting::start_with(screen, folder, protocol, seed, &[], &arguments);
        assert!(sitting.exit_status().success(), "the session is complete");
        sitting.complete_record()
    }

    fn start_with(
        screen: &'a Screen,
        folder: &Path,
        protocol: Protocol,
        seed: u64,
        environment: &[(&'a str, &'a str)],
        more: &[&str],
    ) -> Self {
        let file = folder.join("protocol.toml");
        std::fs::write(&file, protocol.to_toml().unwrap()).unwrap();
        let data = folder.join("study");
        let common = ["--data", data.to_str().unwrap(), "--participant", PARTICIPANT].map(String::from).to_vec();
        let seed_text = seed.to_string();
        let fresh = ["--protocol", file.to_str().unwrap(), "--seed", &seed_text].map(String::from);
        let more: Vec<String> = more.iter().copied().map(String::from).collect();
        let study = Running(screen.study(&[&common[..], &fresh, &more].concat(), environment).spawn().unwrap());
        let environment = environment.to_vec();
        let expected = Experiment::new(protocol.clone(), seed, PARTICIPANT_NUMBER).unwrap();
        let session = data.join(PARTICIPANT);
        Self { screen, protocol, session, common, environment, study, expected, given: Vec::new(), moments: 0 }
    }

    /// What is on the screen before anyone has pressed a key.
    pub fn first_page(&self) -> Pixels {
        wait_for("the first page", || {
            let [pixels, later] = [self.screen.pixels(), self.screen.pixels()];
            // A display without a window and a window before its first page have one colour.
            let written_px = later.rgb.chunks(3).filter(|pixel| **pixel != later.rgb[..3]).count();
            (written_px > 1_000 && pixels == later).then_some(later)
        })
    }

    /// Goes to the next trial: presses the space bar until all of its pictures are on the screen, bit
    /// for bit, and gives it with their corners. The space bar does nothing on a trial's screen.
    pub fn next(&mut self) -> Option<(Trial, Vec<[u32; 2]>)> {
        let trial = next_trial(&mut self.expected)?;
        Some((trial, self.see(&trial)))
    }

    /// The corners of the pictures of `trial`, once they are on the screen.
    pub fn see(&self, trial: &Trial) -> Vec<[u32; 2]> {
        let pictures = self.pictures(trial);
        let what = format!("the pictures of {:?} trial {}, bit for bit", trial.role, trial.number);
        wait_for(&what, || {
            let pixels = self.screen.pixels();
            let corners: Option<Vec<_>> = pictures.iter().map(|picture| pixels.find(picture)).collect();
            if corners.is_none() {
                self.screen.input("key space");
            }
            corners
        })
    }

    /// Answers by `input`, which must mean `answer`, and waits until that is on disk.
    pub fn answer(&mut self, input: &str, answer: Answer) {
        self.give(input, answer);
        self.wait_until_saved();
    }

    /// Answers by `input`, which must mean `answer`; gives the trial.
    fn give(&mut self, input: &str, answer: Answer) -> Trial {
        let trial = *self.expected.stage().trial().unwrap();
        self.screen.input(input);
        self.expected.answer(reply(answer)).unwrap();
        self.given.push((trial, answer));
        trial
    }

    /// Presses the key of the left or the right answer and says whether the answer is on disk when the pictures
    /// vanish: the program draws nothing else before it has tried to write.
    pub fn try_answer_left(&mut self, left: bool) -> bool {
        let (input, answer) = self.side(left);
        let trial = self.give(input, answer);
        let pictures = self.pictures(&trial);
        wait_for("the pictures to vanish", || self.screen.pixels().find(&pictures[0]).is_none().then_some(()));
        self.is_saved()
    }

    /// Waits until every answer is on disk.
    pub fn wait_until_saved(&self) {
        wait_for("the answer on disk", || self.is_saved().then_some(()));
        self.assert_record_is_as_given();
    }

    fn is_saved(&self) -> bool {
        let text = std::fs::read_to_string(self.session.join(EVENTS_FILE)).unwrap_or_default();
        text.matches('\n').count() >= self.given.len() + self.moments
    }

    fn assert_record_is_as_given(&self) {
        let record = self.record();
        let answered = record.events.iter().filter_map(Event::answered);
        assert_eq!(answered.map(|answered| (answered.trial, answered.answer)).collect::<Vec<_>>(), self.given);
    }

    /// Presses the key of the left or the right answer.
    pub fn answer_left(&mut self, left: bool) {
        let (input, answer) = self.side(left);
        self.answer(input, answer);
    }

    /// The key of an answer.
    fn side(&self, left: bool) -> (&'static str, Answer) {
        let answers = self.expected.stage().trial().unwrap().pictures.answers();
        if left { ("key Left", answers[0]) } else { ("key Right", answers[1]) }
    }

    /// Interrupts the session by a key that hides the pictures of `trial`, and goes on.
    pub fn hide_and_show(&mut self, trial: &Trial, key: &str) {
        let left = self.pictures(trial).remove(0);
        self.screen.input(key);
        wait_for("no picture", || self.screen.pixels().find(&left).is_none().then_some(()));
        // An answer to hidden pictures is none.
        self.screen.input("key Left");
        self.screen.input(key);
        self.see(trial);
        self.moments += 2;
    }

    /// The session was paused and went on.
    pub fn interrupted(&mut self) {
        self.moments += 2;
    }

    /// Kills the program.
    pub fn crash(&mut self) {
        self.study.0.kill().unwrap();
        self.study.0.wait().unwrap();
    }

    /// Asks the window manager to close the window, and waits until the program ends.
    pub fn close(&mut self) {
        self.screen.input("key alt+F4");
        assert!(!self.exit_status().success(), "the session is not complete");
        self.moments += 1;
    }

    /// What the program has said, when it has ended; it must have been started by [`Sitting::resume_to_hear`].
    pub fn heard(&mut self) -> String {
        let mut words = String::new();
        self.study.0.stderr.take().unwrap().read_to_string(&mut words).unwrap();
        words
    }

    /// Starts the program anew with --resume.
    pub fn resume(&mut self) {
        self.study = Running(self.resuming(&["--resume"]).spawn().unwrap());
        self.moments += 1;
    }

    /// Like [`Sitting::resume`], to hear what the program says.
    pub fn resume_to_hear(&mut self) {
        self.study = Running(self.resuming(&["--resume"]).stderr(Stdio::piped()).spawn().unwrap());
        self.moments += 1;
    }

    /// Starts the program anew, with the round under way from its beginning.
    pub fn resume_and_repeat_round(&mut self) {
        self.study = Running(self.resuming(&["--resume", "repeat-round"]).spawn().unwrap());
        self.moments += 2;
        self.expected.repeat_round().unwrap();
    }

    /// Throws the session away and starts another one of the same person.
    pub fn discard_and_start(&mut self) {
        self.study = Running(self.resuming(&["--resume", "discard"]).spawn().unwrap());
        self.session.set_extension("2");
        let record = wait_for("another session on disk", || {
            self.screen.input("key space");
            read_session(&self.session).ok()
        });
        let header = record.header;
        assert_eq!(header.protocol, self.protocol);
        self.expected = Experiment::new(header.protocol, header.seed, header.participant_number).unwrap();
        self.given.clear();
        self.moments = 0;
    }

    /// The command that goes on with the session.
    pub fn resuming(&self, how: &[&str]) -> Command {
        let how: Vec<String> = how.iter().copied().map(String::from).collect();
        self.screen.study(&[&self.common[..], &how].concat(), &self.environment)
    }

    /// Where the session lies.
    pub fn session(&self) -> &Path {
        &self.session
    }

    /// The record as it is on disk.
    pub fn record(&self) -> Session {
        read_session(&self.session).unwrap()
    }

    /// Waits until the program ends.
    pub fn exit_status(&mut self) -> ExitStatus {
        wait_for("the program to end", || self.study.0.try_wait().unwrap())
    }

    /// Closes the last screen, and gives the record once it holds what it must: it is complete, it holds the
    /// trials of an undisturbed session and the answers that were given, once each, it replays, and the pictures
    /// that its trials describe have the hashes of those that were drawn.
    pub fn finish(mut self) -> Session {
        assert_eq!(next_trial(&mut self.expected), None, "trials are left");
        wait_for("the end on disk", || {
            self.screen.input("key space");
            self.record().is_complete().then_some(())
        });
        self.screen.input("key space");
        assert!(self.exit_status().success(), "the session is complete");
        self.assert_record_is_as_given();
        let record = self.complete_record();
        for answered in record.events.iter().filter_map(Event::answered) {
            let secs = answered.response_time_secs;
            assert!(secs > 0.05 && secs < 30.0, "response time {secs} s");
        }
        record
    }

    /// The record of a complete session.
    fn complete_record(&self) -> Session {
        let record = self.record();
        assert!(record.is_complete());
        assert!(record.notices.is_empty(), "{:?}", record.notices);
        assert_eq!(*record.replay().unwrap().stage(), Stage::Finished);
        assert_eq!(record.header.participant_number, PARTICIPANT_NUMBER);
        for answered in record.events.iter().filter_map(Event::answered) {
            let hashes: Vec<String> = self.pictures(&answered.trial).iter().map(picture_sha256).collect();
            assert_eq!(answered.pictures_sha256, hashes);
        }
        record
    }

    /// The pictures that a trial describes, from left to right.
    pub fn pictures(&self, trial: &Trial) -> Vec<GrayImage> {
        let rules = self.protocol.pictures;
        let draw = |stimulus: &scumble_stimuli::Stimulus| {
            stimulus.render(rules.width_px, rules.height_px, &Transfer::srgb()).unwrap()
        };
        trial.pictures.all().into_iter().map(draw).collect()
    }
}

impl Drop for Sitting<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.screen.keep_picture();
        }
    }
}

/// Steps over the screens without a question, as the space bar does in the window.
fn next_trial(experiment: &mut Experiment) -> Option<Trial> {
    while experiment.stage().trial().is_none() && *experiment.stage() != Stage::Finished {
        experiment.proceed().unwrap();
    }
    experiment.stage().trial().copied()
}

fn reply(answer: Answer) -> Reply {
    Reply { answer, response_time_secs: 0.0, pictures_sha256: Vec::new(), timing: None }
}
