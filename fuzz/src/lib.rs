//! What the fuzz targets share: the promise of every reader's error, and files for readers of files.

use std::path::PathBuf;

/// Panics unless a message is `FILE:LINE: found; allowed is something`, in one line, of one of the files.
pub fn assert_names_its_place(message: &str, files: &[&str]) {
    let place = files.iter().find_map(|file| message.strip_prefix(file)?.strip_prefix(':'));
    let Some((line, rest)) = place.and_then(|place| place.split_once(": ")) else { panic!("no place: {message}") };
    assert!(line.parse::<usize>().is_ok_and(|line| line > 0), "no line: {message}");
    assert!(rest.contains("; allowed is "), "nothing allowed: {message}");
    assert!(!message.contains('\n'), "more than a line: {message}");
}

/// A file of this process that holds `bytes`, for a reader that takes a path; each call writes it anew.
///
/// # Panics
/// When the system refuses the file.
pub fn file_with(bytes: &[u8]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("scumble-fuzz-{}", std::process::id()));
    match std::fs::write(&path, bytes) {
        Ok(()) => path,
        Err(error) => panic!("{}: {error}", path.display()),
    }
}
