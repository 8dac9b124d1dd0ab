//! Protocol files: refused at a line, or written and read back as they are.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use scumble_fuzz::assert_names_its_place;
use scumble_psychophysics::Protocol;

fuzz_target!(|bytes: &[u8]| {
    match Protocol::from_toml(Path::new("a.toml"), bytes) {
        Err(error) => assert_names_its_place(&error.to_string(), &["a.toml"]),
        Ok(protocol) => {
            let text = protocol.to_toml().expect("a protocol in range has a file");
            let again = Protocol::from_toml(Path::new("a.toml"), text).expect("its file is read");
            assert_eq!(again, protocol);
        }
    }
});
