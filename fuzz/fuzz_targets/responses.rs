//! Tables of the command `quest`: refused with the file's name, or finite intensities.

#![no_main]

use libfuzzer_sys::fuzz_target;
use scumble_analysis::read_responses;
use scumble_fuzz::file_with;

fuzz_target!(|bytes: &[u8]| {
    let path = file_with(bytes);
    match read_responses(&path) {
        Err(error) => assert!(error.to_string().contains(&path.display().to_string()), "{error}"),
        Ok(responses) => assert!(responses.iter().all(|answer| answer.intensity.is_finite())),
    }
});
