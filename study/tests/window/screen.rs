//! A display of its own, a window on it, real keys and real pixels.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use image::GrayImage;

/// What is needed and which Debian package has it.
const PROGRAMS: [(&str, &str); 4] =
    [("Xvfb", "xvfb"), ("openbox", "openbox"), ("xdotool", "xdotool"), ("import", "imagemagick")];

/// A virtual screen with a window manager; both end with it.
pub struct Screen {
    size_px: [u32; 2],
    display: String,
    _programs: Vec<Running>,
}

/// A program that is killed when it is dropped.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Screen {
    /// Starts a screen. Fails with what to install where a program is missing.
    pub fn start(size_px: [u32; 2]) -> Self {
        for (program, package) in PROGRAMS {
            let found = std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default())
                .any(|folder| folder.join(program).is_file());
            assert!(
                found,
                "this test needs the program {program} (Debian package {package}); \
                 `cargo xtask setup` installs everything that tests need"
            );
        }
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0"])
            .arg(format!("{}x{}x24", size_px[0], size_px[1]))
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        let manager = Command::new("openbox").env("DISPLAY", &display).stderr(Stdio::null()).spawn().unwrap();
        Self { size_px, display, _programs: vec![Running(manager), Running(server)] }
    }

    /// Starts the study on this screen.
    pub fn study(&self, arguments: &[String], scale: &str) -> Running {
        let child = Command::new(env!("CARGO_BIN_EXE_scumble-study"))
            .args(arguments)
            .env("DISPLAY", &self.display)
            .env("WINIT_X11_SCALE_FACTOR", scale)
            .env_remove("WAYLAND_DISPLAY")
            .spawn()
            .unwrap();
        Running(child)
    }

    /// Presses and releases a key, or moves and clicks: the words of xdotool.
    pub fn input(&self, words: &str) {
        let mut command = Command::new("xdotool");
        command.args(words.split_whitespace()).env("DISPLAY", &self.display);
        assert!(command.status().unwrap().success(), "xdotool {words}");
    }

    /// What is on the screen.
    pub fn pixels(&self) -> Pixels {
        let output = Command::new("import")
            .args(["-silent", "-window", "root", "-depth", "8", "rgb:-"])
            .env("DISPLAY", &self.display)
            .output()
            .unwrap();
        assert_eq!(output.stdout.len() as u32, self.size_px[0] * self.size_px[1] * 3, "{output:?}");
        Pixels { size_px: self.size_px, rgb: output.stdout }
    }
}

/// A screenshot: red, green, blue, row by row.
#[derive(Clone, PartialEq)]
pub struct Pixels {
    size_px: [u32; 2],
    rgb: Vec<u8>,
}

impl Pixels {
    /// The upper left corner of the first place that shows `picture` texel for pixel and level for
    /// level.
    pub fn find(&self, picture: &GrayImage) -> Option<[u32; 2]> {
        let [width, height] = self.size_px;
        let (picture_width, picture_height) = picture.dimensions();
        let levels = picture.as_raw();
        let agrees = |x: u32, y: u32, index: usize| {
            let (column, row) = (index as u32 % picture_width, index as u32 / picture_width);
            let at = 3 * ((y + row) * width + x + column) as usize;
            self.rgb[at..at + 3].iter().all(|level| *level == levels[index])
        };
        // A sparse comparison rules out almost every place; 7,919 is a prime.
        let sparse = |x, y| (0..levels.len()).step_by(7_919).all(|index| agrees(x, y, index));
        (0..=height - picture_height)
            .flat_map(|y| (0..=width - picture_width).map(move |x| [x, y]))
            .find(|&[x, y]| sparse(x, y) && (0..levels.len()).all(|index| agrees(x, y, index)))
    }

    /// With the rectangle at `corner` blackened.
    pub fn without(mut self, corner: [u32; 2], size: [u32; 2]) -> Self {
        for row in corner[1]..corner[1] + size[1] {
            let start = 3 * (row * self.size_px[0] + corner[0]) as usize;
            self.rgb[start..start + 3 * size[0] as usize].fill(0);
        }
        self
    }
}

/// Asks `done` again and again until it gives something; fails with `what` after half a minute.
pub fn wait_for<T>(what: &str, mut done: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(value) = done() {
            return value;
        }
        assert!(began.elapsed() < Duration::from_secs(30), "waited 30 s for {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_picture_is_found_where_it_is_and_not_with_one_level_changed() {
    let mut pixels = Pixels { size_px: [40, 30], rgb: vec![128; 40 * 30 * 3] };
    let mut picture = GrayImage::from_fn(20, 10, |x, y| image::Luma([(x + 20 * y) as u8]));
    for (x, y, level) in picture.enumerate_pixels() {
        let at = 3 * ((y + 7) * 40 + x + 5) as usize;
        pixels.rgb[at..at + 3].fill(level.0[0]);
    }
    assert_eq!(pixels.find(&picture), Some([5, 7]));
    picture.get_pixel_mut(19, 9).0[0] += 1;
    assert_eq!(pixels.find(&picture), None);
}

#[test]
fn screenshots_without_a_rectangle_are_equal_when_they_differ_inside_it_alone() {
    let plain = Pixels { size_px: [40, 30], rgb: vec![128; 40 * 30 * 3] };
    for (place, is_inside) in [([5, 7], true), ([24, 16], true), ([25, 16], false), ([4, 7], false)] {
        let mut changed = plain.clone();
        changed.rgb[3 * (place[1] * 40 + place[0])] = 129;
        let [a, b] = [&plain, &changed].map(|pixels| pixels.clone().without([5, 7], [20, 10]));
        assert_eq!(a == b, is_inside, "{place:?}");
    }
}
