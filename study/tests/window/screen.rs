//! A display of its own, windows on it, real keys and real pixels.
//!
//! One monitor is Xvfb. Two are Xorg with its dummy driver, which has as many outputs as its configuration
//! names, each a monitor of its own to RandR; it needs neither a graphics card nor a console nor a right.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

use crate::pixels::Pixels;
use crate::programs::{self, Running, program};

/// Where distributions have the X server itself: the program on the path may be one that asks for a console.
const XORG: [&str; 4] = ["/usr/lib/xorg/Xorg", "/usr/libexec/Xorg", "/usr/lib/Xorg", "/usr/bin/Xorg"];

/// A virtual screen with a window manager; both end with it.
pub struct Screen {
    /// Of all monitors together.
    size_px: [u32; 2],
    display: String,
    _programs: [Running; 2],
    _folder: TempDir,
}

impl Screen {
    /// A screen of one monitor. Fails with what to install where a program is missing.
    pub fn start(size_px: [u32; 2]) -> Self {
        let mut server = program("Xvfb", "xvfb");
        server.args(["-screen", "0", &format!("{}x{}x24", size_px[0], size_px[1])]);
        Self::on(server, size_px, tempfile::tempdir().unwrap())
    }

    /// A screen of monitors side by side from left to right, their upper edges in line.
    pub fn of_monitors(sizes_px: &[[u32; 2]]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        std::fs::write(path("xorg.conf"), configuration(sizes_px)).unwrap();
        let mut server = Command::new(programs::file(XORG.map(PathBuf::from), "Xorg", "xserver-xorg-core"));
        server.args(["-config", &path("xorg.conf"), "-logfile", &path("xorg.log")]);
        Self::on(server, enclosing(sizes_px), folder)
    }

    fn on(mut server: Command, size_px: [u32; 2], folder: TempDir) -> Self {
        let (server, number) =
            Running::until_first_line(server.args(["-displayfd", "1", "-nolisten", "tcp", "-noreset"]));
        assert!(!number.is_empty(), "no display");
        let display = format!(":{number}");
        let mut manager = program("openbox", "openbox");
        manager.env("DISPLAY", &display).stdout(Stdio::null()).stderr(Stdio::null());
        Self { size_px, display, _programs: [Running(manager.spawn().unwrap()), server], _folder: folder }
    }

    /// The study on this screen, at a scale factor of 1 where `environment` names no other.
    pub fn study(&self, arguments: &[String], environment: &[(&str, &str)]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_scumble-study"));
        command.args(arguments).env("DISPLAY", &self.display).env("WINIT_X11_SCALE_FACTOR", "1");
        command.env_remove("WAYLAND_DISPLAY").envs(environment.iter().copied());
        command
    }

    /// Presses and releases a key, or moves and clicks: the words of xdotool.
    pub fn input(&self, words: &str) {
        let mut command = program("xdotool", "xdotool");
        command.args(words.split_whitespace()).env("DISPLAY", &self.display);
        assert!(command.status().unwrap().success(), "xdotool {words}");
    }

    /// The title of the window that gets the keys; empty where none does.
    pub fn title_with_keyboard(&self) -> String {
        let mut command = program("xdotool", "xdotool");
        let output = command.args(["getwindowfocus", "getwindowname"]).env("DISPLAY", &self.display).output().unwrap();
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    /// What is on the screen.
    pub fn pixels(&self) -> Pixels {
        let output = program("import", "imagemagick")
            .args(["-silent", "-window", "root", "-depth", "8", "rgb:-"])
            .env("DISPLAY", &self.display)
            .output()
            .unwrap();
        assert_eq!(output.stdout.len() as u32, self.size_px[0] * self.size_px[1] * 3, "{output:?}");
        Pixels { size_px: self.size_px, rgb: output.stdout }
    }

    /// Keeps a picture of the screen for whoever asks why the test failed, and says where.
    pub fn keep_picture(&self) {
        let test = std::thread::current().name().unwrap_or("test").replace("::", "-");
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test).with_extension("png");
        let mut command = program("import", "imagemagick");
        let kept = command.args(["-silent", "-window", "root"]).arg(&path).env("DISPLAY", &self.display).status();
        if kept.is_ok_and(|status| status.success()) {
            eprintln!("the screen when the test failed: {}", path.display());
        }
    }
}

/// Width and height of monitors side by side.
fn enclosing(sizes_px: &[[u32; 2]]) -> [u32; 2] {
    [sizes_px.iter().map(|size| size[0]).sum(), sizes_px.iter().map(|size| size[1]).max().unwrap()]
}

/// Xorg's configuration: one dummy card, one output for each monitor.
fn configuration(sizes_px: &[[u32; 2]]) -> String {
    let mut monitors = String::new();
    let mut outputs = String::new();
    for (index, [width, height]) in sizes_px.iter().enumerate() {
        let beside = match index {
            0 => String::new(),
            _ => format!("Option \"RightOf\" \"DUMMY{}\"", index - 1),
        };
        // Blanking of VESA's reduced timings, 60 pictures a second.
        let [columns, rows] = [width + 160, height + 30];
        let clock_mhz = f64::from(columns * rows) * 60.0 / 1e6;
        let across = format!("{width} {} {} {columns}", width + 48, width + 80);
        let down = format!("{height} {} {} {rows}", height + 3, height + 9);
        write!(
            monitors,
            r#"
Section "Monitor"
  Identifier "monitor{index}"
  HorizSync 1-1000
  VertRefresh 1-1000
  Modeline "{width}x{height}" {clock_mhz:.2} {across} {down}
  Option "PreferredMode" "{width}x{height}"
  Option "Enable" "true"
  {beside}
EndSection"#
        )
        .unwrap();
        writeln!(outputs, "  Option \"Monitor-DUMMY{index}\" \"monitor{index}\"").unwrap();
    }
    let [width, height] = enclosing(sizes_px);
    let memory_kib = width * height * 4 / 1024 + 1;
    format!(
        r#"Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "AutoAddGPU" "false"
EndSection{monitors}
Section "Device"
  Identifier "card"
  Driver "dummy"
  VideoRam {memory_kib}
{outputs}EndSection
Section "Screen"
  Identifier "screen"
  Device "card"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Virtual {width} {height}
  EndSubSection
EndSection
"#
    )
}
