//! Files of one result, replaced together or not at all.
//!
//! A file is only replaced when it is an earlier output of the same kind, which its mark tells (the
//! schema of `relation.json`, the header of a table, a comment in a page or figure). Everything is
//! written beside its place first and renamed then, so that a reader never sees half a file.

use std::path::{Path, PathBuf};

use crate::Error;

/// A file to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Its name in the folder.
    pub name: &'static str,
    /// Its content.
    pub content: String,
    /// What every earlier output of its kind contains.
    pub mark: &'static str,
}

/// Writes all `outputs` into `folder`, which is made where it does not exist.
///
/// # Errors
/// A file of another kind under one of the names, before anything is written; the system's refusals.
pub fn write_outputs(folder: &Path, outputs: &[Output]) -> Result<(), Error> {
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    for output in outputs {
        check_own(&folder.join(output.name), output.mark)?;
    }
    let partial = |output: &Output| -> PathBuf { folder.join(format!(".{}.partial", output.name)) };
    for output in outputs {
        let path = partial(output);
        std::fs::write(&path, &output.content).map_err(Error::io(&path))?;
    }
    for output in outputs {
        let path = folder.join(output.name);
        std::fs::rename(partial(output), &path).map_err(Error::io(&path))?;
    }
    Ok(())
}

/// Refuses to replace what is not an earlier output.
fn check_own(path: &Path, mark: &str) -> Result<(), Error> {
    if !path.exists() {
        return Ok(());
    }
    let own = std::fs::read_to_string(path).is_ok_and(|content| content.contains(mark));
    if own {
        return Ok(());
    }
    let reason = "exists and is not an earlier output of this command; allowed is another --out";
    Err(Error::File { path: path.to_path_buf(), reason: reason.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output(content: &str) -> Output {
        Output { name: "a.txt", content: content.to_owned(), mark: "mark" }
    }

    #[test]
    fn an_earlier_output_is_replaced_and_no_part_is_left_behind() {
        let folder = tempfile::tempdir().unwrap();
        write_outputs(folder.path(), &[output("mark 1")]).unwrap();
        write_outputs(folder.path(), &[output("mark 2")]).unwrap();
        let names: Vec<_> = std::fs::read_dir(folder.path()).unwrap().collect();
        assert_eq!(names.len(), 1);
        assert_eq!(std::fs::read_to_string(folder.path().join("a.txt")).unwrap(), "mark 2");
    }

    #[test]
    fn a_file_of_another_kind_is_kept_and_nothing_is_written() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.txt"), "a letter").unwrap();
        let other = Output { name: "b.txt", ..output("mark") };
        let refusal = write_outputs(folder.path(), &[other, output("mark")]).unwrap_err();
        assert!(refusal.to_string().contains("a.txt: exists"), "{refusal}");
        assert!(!folder.path().join("b.txt").exists());
        assert_eq!(std::fs::read_to_string(folder.path().join("a.txt")).unwrap(), "a letter");
    }
}
