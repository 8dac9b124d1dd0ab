//! What the machine must have beside Rust, and how it gets it.
//!
//! A need is looked for by what programs use (a driver's manifest, a program on the path), not by package name,
//! so that a machine set up by other means is left alone. Only Debian and Ubuntu are changed, by `apt-get`.

use crate::run;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// Something the programs or tests need to build or to run.
#[derive(Clone, Copy)]
pub struct Need {
    purpose: &'static str,
    present: fn() -> bool,
    /// Debian's and Ubuntu's package names.
    packages: &'static [&'static str],
}

/// A compiler of C++ under the name that Cargo's build scripts call.
pub const COMPILER: Need =
    Need { purpose: "a C++ compiler (build of the FLIP metric)", present: has_compiler, packages: &["g++"] };

/// A Vulkan loader and a driver; llvmpipe where the machine has no graphics card.
pub const VULKAN: Need = Need {
    purpose: "a Vulkan driver (pictures, benchmark, GPU tests)",
    present: has_vulkan,
    packages: &["libvulkan1", "mesa-vulkan-drivers"],
};

/// Displays of one and two monitors, a window manager, keys, screenshots, small disks and a clock for tests of the
/// real window.
pub const WINDOWS: Need = Need {
    purpose: "virtual displays with keys and screenshots, small disks and a clock to set (tests of the study window)",
    present: has_window_tools,
    packages: &[
        "xvfb",
        "xserver-xorg-core",
        "xserver-xorg-video-dummy",
        "xdotool",
        "openbox",
        "imagemagick",
        "libfaketime",
        "mount",
        "util-linux",
        "libx11-xcb1",
        "libxcursor1",
        "libxi6",
        "libxkbcommon-x11-0",
    ],
};

/// Makes every need present, or says exactly what to install.
pub fn provide(needs: &[Need]) -> Result<()> {
    // Other systems bring their graphics interface along, and have no virtual display to install.
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let missing: Vec<&Need> = needs.iter().filter(|need| !(need.present)()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let purposes = missing.iter().map(|need| need.purpose).collect::<Vec<_>>().join("; ");
    let packages: Vec<&str> = missing.iter().flat_map(|need| need.packages.iter().copied()).collect();
    let by_hand = format!("apt-get install --no-install-recommends {}", packages.join(" "));
    if !Path::new("/usr/bin/apt-get").exists() {
        bail!("missing: {purposes}. Install what Debian calls: {}", packages.join(" "));
    }
    println!("Missing: {purposes}.\nInstalling: {}", packages.join(" "));
    install(&packages).with_context(|| format!("could not install. Run as root, then try again: {by_hand}"))?;
    match missing.iter().find(|need| !(need.present)()) {
        Some(need) => bail!("installed {}, yet there is still no sign of {}", packages.join(" "), need.purpose),
        None => Ok(()),
    }
}

/// Refreshes the lists (a new machine has none) and installs; asks `sudo` only where the user is not root.
fn install(packages: &[&str]) -> Result<()> {
    let root = run::output("id", &["-u"])?.trim() == "0";
    // `sudo` drops the environment, and a package with questions (a keyboard's layout) must not ask them.
    let by_sudo: &[&str] = &["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"];
    let (program, prefix): (&str, &[&str]) = if root { ("apt-get", &[]) } else { ("sudo", by_sudo) };
    let quiet = ["-qq", "-o", "Dpkg::Use-Pty=0"];
    let update = [prefix, &["update"], &quiet].concat();
    let install = [prefix, &["install", "-y", "--no-install-recommends"], &quiet, packages].concat();
    run::visibly(program, &update)?;
    run::visibly(program, &install)
}

fn has_compiler() -> bool {
    std::env::var_os("CXX").is_some() || on_path("c++")
}

fn has_vulkan() -> bool {
    let named_by_user = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].iter().any(|name| std::env::var_os(name).is_some());
    let manifests = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"];
    let driver = named_by_user || manifests.iter().any(|folder| holds_a_file(Path::new(folder)));
    driver && has_library("libvulkan.so.1")
}

fn has_library(name: &str) -> bool {
    run::output("ldconfig", &["-p"])
        .or_else(|_| run::output("/sbin/ldconfig", &["-p"]))
        .is_ok_and(|libraries| libraries.contains(name))
}

fn holds_a_file(folder: &Path) -> bool {
    std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some())
}

fn has_window_tools() -> bool {
    let programs = ["Xvfb", "Xorg", "xdotool", "openbox", "import", "unshare", "nsenter", "mount"];
    let libraries = ["libX11-xcb.so.1", "libXcursor.so.1", "libXi.so.6", "libxkbcommon-x11.so.0"];
    let below_libraries = ["xorg/modules/drivers/dummy_drv.so", "faketime/libfaketime.so.1"];
    programs.iter().all(|name| on_path(name))
        && libraries.iter().all(|name| has_library(name))
        && below_libraries.iter().all(|file| is_below_libraries(file))
}

/// Whether a folder of libraries has `file`: `/usr/lib`, `/usr/lib64`, or one in them such as Debian's `x86_64-linux-gnu`.
fn is_below_libraries(file: &str) -> bool {
    let has = |folder: &Path| folder.join(file).is_file();
    ["/usr/lib", "/usr/lib64"].map(Path::new).into_iter().any(|folder| {
        let mut inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
        has(folder) || inside.any(|entry| has(&entry.path()))
    })
}

/// Whether a program of this file name is on the path.
pub fn on_path(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}
