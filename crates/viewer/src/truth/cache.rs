//! Truths that were computed before, whole or in part.
//!
//! A truth is found by the hash of everything that it depends on ([`crate::truth::key`]), in a folder of that name. It
//! is kept in blocks of rows, one file each, so that a run that was killed goes on where it stopped. A file takes its
//! name only when it is complete (it is written beside, then renamed), and carries version, key, rows and a checksum: one
//! that is cut off, damaged or of another version is named and computed anew. Everything here may be deleted at any time.
//!
//! A block: one line of text `scumble truth block V KEY FIRST_ROW ROWS WIDTH`, then visibility and standard error of
//! every pixel as little-endian f32, row by row, then SHA-256 of all that.

use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use scumble_reference::Estimate;
use sha2::{Digest, Sha256};

use crate::truth::key::Key;

/// Of a block's format.
const VERSION: u32 = 1;
/// How each block begins, whatever its version.
const MAGIC: &str = "scumble truth block";
/// Bytes of SHA-256.
const CHECKSUM: usize = 32;
/// Bytes of an estimate.
const ESTIMATE: usize = 8;

/// The blocks of one truth.
pub struct Cache {
    folder: PathBuf,
    key: Key,
    width_px: u32,
}

/// Rows of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows {
    /// The uppermost.
    pub first: u32,
    /// How many.
    pub count: u32,
}

impl Rows {
    /// Indices of the pixels of these rows, `width_px` in each.
    pub fn pixels(self, width_px: u32) -> Range<usize> {
        let start = |row: u32| row as usize * width_px as usize;
        start(self.first)..start(self.first + self.count)
    }
}

impl Cache {
    /// The folder of a truth below `directory`; both are made if missing.
    pub fn open(directory: &Path, key: Key, width_px: u32) -> Result<Self> {
        let folder = directory.join(key.to_string());
        fs::create_dir_all(&folder).with_context(|| format!("{}: cannot be made a cache", folder.display()))?;
        Ok(Self { folder, key, width_px })
    }

    /// Where a block is or will be.
    pub fn path(&self, rows: Rows) -> PathBuf {
        self.folder.join(format!("rows-{:05}.block", rows.first))
    }

    /// A block that was kept; `None` where there is none.
    ///
    /// # Errors
    /// Says what is wrong with a file that is there and cannot be trusted.
    pub fn read(&self, rows: Rows) -> Result<Option<Vec<Estimate>>, String> {
        match fs::read(self.path(rows)) {
            Ok(bytes) => self.decode(rows, &bytes).map(Some),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("cannot be read ({error})")),
        }
    }

    /// Keeps a block.
    pub fn write(&self, rows: Rows, estimates: &[Estimate]) -> Result<()> {
        let path = self.path(rows);
        // Another process may be at work on the same truth.
        let partial = path.with_extension(format!("{}.partial", std::process::id()));
        let written = File::create(&partial).and_then(|mut file| {
            file.write_all(&self.encode(rows, estimates))?;
            file.sync_all()?;
            fs::rename(&partial, &path)
        });
        written.with_context(|| format!("{}: cannot be written", path.display()))
    }

    fn header(&self, rows: Rows) -> String {
        format!("{MAGIC} {VERSION} {} {} {} {}\n", self.key, rows.first, rows.count, self.width_px)
    }

    fn encode(&self, rows: Rows, estimates: &[Estimate]) -> Vec<u8> {
        let mut bytes = self.header(rows).into_bytes();
        let values = estimates.iter().flat_map(|estimate| [estimate.visibility, estimate.standard_error]);
        bytes.extend(values.flat_map(f32::to_le_bytes));
        let checksum = Sha256::digest(&bytes);
        bytes.extend_from_slice(&checksum);
        bytes
    }

    fn decode(&self, rows: Rows, bytes: &[u8]) -> Result<Vec<Estimate>, String> {
        let header = self.header(rows);
        let Some(body) = bytes.strip_prefix(header.as_bytes()) else {
            return Err(match bytes.starts_with(format!("{MAGIC} ").as_bytes()) {
                true => format!("is of another version or of other rows than \"{}\"", header.trim_end()),
                false => "is no block of a truth".to_owned(),
            });
        };
        let pixels = rows.pixels(self.width_px).len();
        if body.len() != pixels * ESTIMATE + CHECKSUM {
            let expected = header.len() + pixels * ESTIMATE + CHECKSUM;
            return Err(format!("has {} bytes and not the {expected} of its rows", bytes.len()));
        }
        let (data, checksum) = bytes.split_at(bytes.len() - CHECKSUM);
        if Sha256::digest(data).as_slice() != checksum {
            return Err("is damaged: its checksum is another".to_owned());
        }
        let value = |at: usize| f32::from_le_bytes([body[at], body[at + 1], body[at + 2], body[at + 3]]);
        let estimate = |pixel: usize| {
            let at = pixel * ESTIMATE;
            Estimate { visibility: value(at), standard_error: value(at + ESTIMATE / 2) }
        };
        Ok((0..pixels).map(estimate).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: Rows = Rows { first: 16, count: 2 };

    fn estimates() -> Vec<Estimate> {
        let estimate = |i: u8| Estimate { visibility: f32::from(i) / 6.0, standard_error: f32::from(i) / 100.0 };
        (0..6).map(estimate).collect()
    }

    fn cache(directory: &Path, key: u8) -> Cache {
        Cache::open(directory, Key::of_bytes(&[key]), 3).unwrap()
    }

    #[test]
    fn a_block_is_read_as_it_was_written_and_another_is_not_there() {
        let directory = tempfile::tempdir().unwrap();
        let cache = cache(directory.path(), 1);
        assert_eq!(cache.read(ROWS), Ok(None));
        cache.write(ROWS, &estimates()).unwrap();
        assert_eq!(cache.read(ROWS), Ok(Some(estimates())));
        assert_eq!(cache.read(Rows { first: 0, count: 2 }), Ok(None));
        assert_eq!(Cache::open(directory.path(), Key::of_bytes(&[2]), 3).unwrap().read(ROWS), Ok(None));
        assert_eq!(fs::read_dir(cache.folder).unwrap().count(), 1, "nothing is left beside the block");
    }

    #[test]
    fn a_block_with_any_byte_changed_or_missing_is_never_trusted() {
        let directory = tempfile::tempdir().unwrap();
        let cache = cache(directory.path(), 1);
        let bytes = cache.encode(ROWS, &estimates());
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 0x40;
            assert!(cache.decode(ROWS, &damaged).is_err(), "{at}");
            assert!(cache.decode(ROWS, &bytes[..at]).is_err(), "{at}");
        }
        assert!(cache.decode(ROWS, &[&bytes[..], b"x"].concat()).is_err());
    }

    #[test]
    fn what_is_wrong_is_said_in_words() {
        let directory = tempfile::tempdir().unwrap();
        let cache = cache(directory.path(), 1);
        let bytes = cache.encode(ROWS, &estimates());
        let complaint = |bytes: &[u8]| cache.decode(ROWS, bytes).unwrap_err();
        let newer = String::from_utf8_lossy(&bytes).replacen("block 1", "block 2", 1);
        assert!(complaint(newer.as_bytes()).contains("another version"));
        assert!(complaint(&bytes[..bytes.len() - 1]).contains("bytes"));
        assert!(complaint(b"").contains("no block"));
        let mut damaged = bytes.clone();
        damaged[bytes.len() - 40] ^= 1;
        assert!(complaint(&damaged).contains("checksum"));
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_named() {
        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("file");
        fs::write(&file, "").unwrap();
        let refused = Cache::open(&file, Key::of_bytes(&[1]), 3).err().unwrap().to_string();
        assert!(refused.contains("file"), "{refused}");
    }
}
