//! Tables of the command `threshold`: refused with the file's name, or counts that can be fitted.

#![no_main]

use libfuzzer_sys::fuzz_target;
use scumble_analysis::read_count_table;
use scumble_fuzz::file_with;

fuzz_target!(|bytes: &[u8]| {
    let path = file_with(bytes);
    match read_count_table(&path) {
        Err(error) => assert!(error.to_string().contains(&path.display().to_string()), "{error}"),
        Ok(counts) => assert!(counts.iter().all(|count| count.x.is_finite() && count.correct <= count.total)),
    }
});
