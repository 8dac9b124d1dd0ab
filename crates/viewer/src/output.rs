//! Files that the commands write. A result takes the place of an older one of its own kind and of nothing else.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use serde::Serialize;

use crate::npy::MAGIC;

/// What a file holds, told by its name and its first bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A picture.
    Png,
    /// A record of this program of this `schema`; other files of the project are JSON too.
    Json(&'static str),
    /// A table whose first column is `scene`.
    Csv,
    /// A page with this mark of the command that writes it.
    Html(&'static str),
    /// The same for a text with tables.
    Markdown(&'static str),
    /// An array for NumPy, described by the JSON file of the same name.
    Npy,
}

impl Kind {
    fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Json(_) => "json",
            Self::Csv => "csv",
            Self::Html(_) => "html",
            Self::Markdown(_) => "md",
            Self::Npy => "npy",
        }
    }

    /// Whether an existing file is one of these.
    fn matches(self, path: &Path, bytes: &[u8]) -> bool {
        match self {
            Self::Png => bytes.starts_with(b"\x89PNG\r\n\x1a\n"),
            Self::Csv => bytes.starts_with(b"scene,"),
            Self::Html(mark) | Self::Markdown(mark) => String::from_utf8_lossy(bytes).contains(mark),
            // NAME.npy and NAME.se.npy have the record NAME.json.
            Self::Npy => {
                let named = path.with_extension("");
                bytes.starts_with(MAGIC) && [path, &named].iter().any(|path| path.with_extension("json").is_file())
            }
            Self::Json(schema) => {
                serde_json::from_slice::<serde_json::Value>(bytes).is_ok_and(|value| value["schema"] == schema)
            }
        }
    }
}

/// A path that may be written: its extension is right, its directory is there, and what it replaces is of its kind.
///
/// Called before long work, so that the work is not lost to a slip of the pen.
pub fn claim(path: &Path, kind: Kind) -> Result<PathBuf> {
    let extension = kind.extension();
    let named_right = path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension));
    ensure!(named_right, "{}: the name of this output must end in .{extension}", path.display());
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    if let Some(directory) = directory {
        ensure!(directory.is_dir(), "{}: the directory {} does not exist", path.display(), directory.display());
    }
    if path.exists() {
        let bytes = fs::read(path).with_context(|| format!("{}: cannot be replaced", path.display()))?;
        if !kind.matches(path, &bytes) {
            bail!("{}: is there and is no {extension} file of this command; choose another name", path.display());
        }
    }
    Ok(path.to_owned())
}

/// A picture and its record of the same name beside it. A picture without its record is somebody else's.
pub fn claim_with_record(picture: &Path, schema: &'static str) -> Result<(PathBuf, PathBuf)> {
    let record = claim(&picture.with_extension("json"), Kind::Json(schema))?;
    let picture = claim(picture, Kind::Png)?;
    ensure!(
        record.exists() || !picture.exists(),
        "{}: is there without this program's record beside it; choose another name",
        picture.display()
    );
    Ok((picture, record))
}

/// Makes the directory of a command's results.
pub fn make_directory(path: &Path) -> Result<()> {
    fs::create_dir_all(path).with_context(|| format!("{}: cannot be made a directory", path.display()))
}

/// Writes a record.
pub fn write_json(path: &Path, record: &impl Serialize) -> Result<()> {
    let mut text = serde_json::to_string_pretty(record).context("the record cannot be written as JSON")?;
    text.push('\n');
    write(path, text.as_bytes())
}

/// Writes a picture.
pub fn write_png(path: &Path, picture: &image::RgbImage) -> Result<()> {
    let mut bytes = Vec::new();
    picture
        .write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png)
        .with_context(|| format!("{}: cannot be encoded", path.display()))?;
    write(path, &bytes)
}

/// Writes bytes.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    fs::write(path, bytes).with_context(|| format!("{}: cannot be written", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_replaces_its_own_kind_and_nothing_else() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("notes.json");
        let kind = Kind::Json("scumble/shot/1");
        claim(&path, kind).unwrap();
        write_json(&path, &serde_json::json!({ "schema": "scumble/shot/1" })).unwrap();
        claim(&path, kind).unwrap();
        for other in [r#"{ "name": "somebody's package" }"#, r#"{ "schema": "scumble/relation/1" }"#] {
            fs::write(&path, other).unwrap();
            let refused = claim(&path, kind).unwrap_err().to_string();
            assert!(refused.contains("notes.json") && refused.contains("choose another name"), "{refused}");
        }
    }

    #[test]
    fn a_picture_without_its_record_is_somebody_elses() {
        let directory = tempfile::tempdir().unwrap();
        let picture = directory.path().join("holiday.png");
        fs::write(&picture, b"\x89PNG\r\n\x1a\n").unwrap();
        let refused = claim_with_record(&picture, "scumble/shot/1").unwrap_err().to_string();
        assert!(refused.contains("holiday.png"), "{refused}");
        write_json(&picture.with_extension("json"), &serde_json::json!({ "schema": "scumble/shot/1" })).unwrap();
        claim_with_record(&picture, "scumble/shot/1").unwrap();
    }

    #[test]
    fn a_wrong_extension_is_refused() {
        let refused = claim(Path::new("picture.jpg"), Kind::Png).unwrap_err().to_string();
        assert!(refused.contains("picture.jpg") && refused.contains(".png"), "{refused}");
    }

    #[test]
    fn a_missing_directory_is_named_before_the_work() {
        let refused = claim(Path::new("nowhere/at/all.png"), Kind::Png).unwrap_err().to_string();
        assert!(refused.contains("nowhere/at"), "{refused}");
    }
}
