//! `relation.json`: refused, or a relation in range whose file is read back as it is.

#![no_main]

use libfuzzer_sys::fuzz_target;
use scumble_core::RelationFile;

fuzz_target!(|json: &str| {
    if let Ok(file) = RelationFile::from_json(json) {
        file.relation().expect("a file in range has a relation");
        let json = file.to_json().expect("a file that was read can be written");
        assert_eq!(RelationFile::from_json(&json).expect("and read again"), file);
    }
});
