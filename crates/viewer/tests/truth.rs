//! The command `truth` as a user meets it: its numbers, its files, and that a run that was killed goes on.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Rows of a block of the cache.
const BLOCK: u64 = 16;

/// A small picture of *contact*: `height` rows of a view as wide as 16:9, its files in `directory`.
struct Small<'a> {
    directory: &'a Path,
    height: u64,
    arguments: &'a [&'a str],
}

impl Small<'_> {
    fn width(&self) -> u64 {
        self.height * 16 / 9
    }

    fn out(&self) -> PathBuf {
        self.directory.join("truth.png")
    }

    fn cache(&self) -> PathBuf {
        self.directory.join("cache")
    }

    /// Without Mesa's layer that complains on standard error where there is no Wayland display.
    fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_scumble-viewer"));
        command.env("NODEVICE_SELECT", "1").args(["truth", "--scene", "contact"]).args(self.arguments);
        command.args(["--width", &self.width().to_string(), "--height", &self.height.to_string()]);
        command.arg("--out").arg(self.out()).arg("--cache").arg(self.cache());
        command
    }

    fn run(&self) -> Output {
        let output = self.command().output().expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        output
    }

    fn complaint(&self) -> String {
        let output = self.command().output().expect("the program starts");
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert_eq!(text.trim_end().lines().count(), 1, "{text}");
        text
    }

    fn record(&self) -> serde_json::Value {
        serde_json::from_slice(&fs::read(self.out().with_extension("json")).unwrap()).unwrap()
    }

    /// The values of an array, whose header must say this picture's shape.
    fn array(&self, extension: &str) -> Vec<f32> {
        let bytes = fs::read(self.out().with_extension(extension)).unwrap();
        assert!(bytes.starts_with(b"\x93NUMPY\x01\x00"));
        let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
        assert!(
            header.contains("'<f4'") && header.contains(&format!("({}, {})", self.height, self.width())),
            "{header}"
        );
        let values = bytes[10 + length..].chunks_exact(4);
        let values: Vec<f32> =
            values.map(|bytes| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])).collect();
        assert_eq!(values.len() as u64, self.height * self.width());
        values
    }

    /// The files of the cache's one truth, from the first row on.
    fn blocks(&self) -> Vec<PathBuf> {
        let truths = fs::read_dir(self.cache()).into_iter().flatten().flatten();
        let files = truths.flat_map(|truth| fs::read_dir(truth.path()).into_iter().flatten().flatten());
        let mut blocks: Vec<PathBuf> =
            files.map(|file| file.path()).filter(|path| path.extension().is_some_and(|kind| kind == "block")).collect();
        blocks.sort();
        blocks
    }
}

#[test]
fn the_kernel_truth_is_a_picture_an_array_and_a_record_that_agree() {
    let directory = tempfile::tempdir().unwrap();
    let small = Small { directory: directory.path(), height: 36, arguments: &["--method", "pcf"] };
    small.run();
    let picture = image::open(small.out()).unwrap();
    assert_eq!((u64::from(picture.width()), u64::from(picture.height())), (small.width(), small.height));
    let visibility = small.array("npy");
    // Each is the mean of 25 taps.
    assert!(visibility.iter().all(|v| (v * 25.0 - (v * 25.0).round()).abs() < 1e-4 && (0.0..=1.0).contains(v)));
    assert!(visibility.iter().any(|v| *v < 0.1), "there is a shadow");
    let record = small.record();
    assert_eq!((&record["schema"], &record["truth"]), (&"scumble/truth/2".into(), &"kernel".into()));
    assert_eq!((&record["method"], &record["samples"]), (&"pcf".into(), &25.into()));
    assert!(record["standard_error"].is_null());
    assert!(!small.out().with_extension("se.npy").exists());
}

#[test]
fn the_light_truth_has_a_standard_error_of_every_pixel_and_is_near_the_kernel_where_that_is_right() {
    let directory = tempfile::tempdir().unwrap();
    let kernel = Small { directory: directory.path(), height: 36, arguments: &["--method", "pcss"] };
    kernel.run();
    let filtered = kernel.array("npy");
    let light = Small { directory: directory.path(), height: 36, arguments: &["--truth", "light", "--samples", "128"] };
    light.run();
    let (visibility, errors) = (light.array("npy"), light.array("se.npy"));

    let record = light.record();
    assert_eq!((&record["truth"], &record["samples"]), (&"light".into(), &128.into()));
    assert!(record["method"].is_null() && record["pcf_radius_plane"].is_null());
    let largest = record["standard_error"]["max"].as_f64().unwrap();
    assert!(largest > 1.0 / 128.0 && largest < 0.05, "{record}");
    // The sky is exact; no other pixel knows better than 1 of 128.
    assert!(errors.iter().all(|&error| error == 0.0 || f64::from(error) > 0.99 / 128.0));
    assert!(errors.iter().any(|&error| error > 0.0));

    // PCSS is an approximation of this light: alike in most pixels, and not the same.
    let differences = || filtered.iter().zip(&visibility).map(|(a, b)| (a - b).abs());
    let near = differences().filter(|difference| *difference < 0.1).count();
    assert!(near * 10 > 9 * visibility.len(), "{near} of {}", visibility.len());
    assert!(differences().any(|difference| difference > 0.0));
}

#[test]
fn numbers_of_samples_that_are_none_are_refused_before_any_work() {
    let directory = tempfile::tempdir().unwrap();
    for (truth, samples) in [("light", "100"), ("light", "32"), ("kernel", "0"), ("kernel", "5000")] {
        let arguments = ["--truth", truth, "--samples", samples];
        let line = Small { directory: directory.path(), height: 36, arguments: &arguments }.complaint();
        assert!(line.contains(samples) && line.contains("1024"), "{line}");
    }
    let line = Small { directory: directory.path(), height: 36, arguments: &["--truth", "magic"] }.complaint();
    assert!(line.contains("magic") && line.contains("kernel"), "{line}");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[test]
fn a_second_run_takes_every_row_from_the_cache_and_other_options_take_none() {
    let directory = tempfile::tempdir().unwrap();
    let small = Small { directory: directory.path(), height: 36, arguments: &["--truth", "light", "--samples", "64"] };
    small.run();
    assert_eq!(small.record()["rows_from_cache"], 0);
    let first = small.array("npy");
    small.run();
    assert_eq!(small.record()["rows_from_cache"], 36);
    assert_eq!(small.array("npy"), first);
    for arguments in
        [&["--truth", "light", "--samples", "128"], &["--light-size", "2", "--truth", "light"]] as [&[&str]; 2]
    {
        let other = Small { directory: directory.path(), height: 36, arguments };
        other.run();
        assert_eq!(other.record()["rows_from_cache"], 0, "{arguments:?}");
    }
}

#[test]
fn what_is_damaged_or_of_another_version_in_the_cache_is_named_and_computed_anew() {
    let directory = tempfile::tempdir().unwrap();
    let small = Small { directory: directory.path(), height: 72, arguments: &["--truth", "light", "--samples", "64"] };
    small.run();
    let (visibility, errors) = (small.array("npy"), small.array("se.npy"));
    let blocks = small.blocks();
    assert_eq!(blocks.len() as u64, 72_u64.div_ceil(BLOCK));

    let mut damaged = fs::read(&blocks[1]).unwrap();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    fs::write(&blocks[1], damaged).unwrap();
    let whole = fs::read(&blocks[2]).unwrap();
    fs::write(&blocks[2], &whole[..whole.len() / 2]).unwrap();
    let newer = String::from_utf8_lossy(&fs::read(&blocks[3]).unwrap()).replacen("block 1", "block 9", 1);
    fs::write(&blocks[3], newer).unwrap();

    let output = small.run();
    let warnings = String::from_utf8(output.stderr).unwrap();
    assert_eq!(warnings.lines().count(), 3, "{warnings}");
    for (block, word) in [(&blocks[1], "checksum"), (&blocks[2], "bytes"), (&blocks[3], "version")] {
        let name = block.file_name().unwrap().to_str().unwrap();
        assert!(warnings.lines().any(|line| line.contains(name) && line.contains(word)), "{word}: {warnings}");
    }
    assert_eq!(small.record()["rows_from_cache"], 72 - 3 * BLOCK);
    assert_eq!((small.array("npy"), small.array("se.npy")), (visibility, errors));
    assert!(small.run().stderr.is_empty(), "all is well again");
}

#[test]
fn a_run_that_is_killed_goes_on_where_it_stopped() {
    let directory = tempfile::tempdir().unwrap();
    let arguments = ["--truth", "light", "--samples", "512"];
    let small = Small { directory: directory.path(), height: 96, arguments: &arguments };
    let mut killed = small.command().stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let started = Instant::now();
    while small.blocks().len() < 2 {
        assert!(killed.try_wait().unwrap().is_none(), "it ended before it was killed");
        assert!(started.elapsed() < Duration::from_secs(120), "no rows in two minutes");
        sleep(Duration::from_millis(2));
    }
    killed.kill().unwrap();
    killed.wait().unwrap();
    let kept = small.blocks().len() as u64;
    assert!(kept < 96 / BLOCK && !small.out().exists(), "{kept} blocks");

    small.run();
    assert_eq!(small.record()["rows_from_cache"], kept * BLOCK);
    let went_on = small.array("npy");
    fs::remove_dir_all(small.cache()).unwrap();
    small.run();
    assert_eq!(small.record()["rows_from_cache"], 0);
    assert_eq!(small.array("npy"), went_on);
}
