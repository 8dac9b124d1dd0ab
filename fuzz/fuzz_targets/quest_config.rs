//! Configurations of the command `quest`: refused with the file's name, or a QUEST that takes responses.

#![no_main]

use libfuzzer_sys::fuzz_target;
use scumble_analysis::read_quest_config;
use scumble_fuzz::file_with;
use scumble_psychophysics::QuestSummary;

/// Longest table that is run: a longer one is as right, and slow.
const POINTS_MAX: f64 = 10_000.0;

fuzz_target!(|bytes: &[u8]| {
    let path = file_with(bytes);
    match read_quest_config(&path) {
        Err(error) => assert!(error.to_string().contains(&path.display().to_string()), "{error}"),
        Ok(config) if config.range / config.grain <= POINTS_MAX => {
            // A response that no threshold explains is an error, never a panic.
            let _ = QuestSummary::of_sequence(config, &[(0.0, true), (-1e300, false), (config.t_guess, true)]);
        }
        Ok(_) => (),
    }
});
