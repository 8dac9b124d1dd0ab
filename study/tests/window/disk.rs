//! A small disk of its own that can run full, be read-only, and be well again.
//!
//! It is a file system in memory, mounted in a mount namespace of its own, which needs no right but that of
//! every user to make namespaces. A process keeps the namespace; its view of the file system, `/proc/ID/root`,
//! is a folder like any other for everyone else.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::programs::{Running, program};

/// Room on the disk: some hundred answers.
const SIZE_KIB: u32 = 256;
/// What takes all the room that is left.
const FILLER: &str = "filler";

/// The disk; it ends with this.
pub struct Disk {
    keeper: Running,
    mount_point: TempDir,
    folder: PathBuf,
}

impl Disk {
    /// An empty disk.
    pub fn new() -> Self {
        let mount_point = tempfile::tempdir().unwrap();
        let script = format!("mount -t tmpfs -o size={SIZE_KIB}k scumble \"$0\" && echo ready && exec sleep infinity");
        let mut unshare = program("unshare", "util-linux");
        unshare.args(["--user", "--map-root-user", "--mount", "sh", "-c", &script]).arg(mount_point.path());
        let (keeper, ready) = Running::until_first_line(&mut unshare);
        assert_eq!(
            ready, "ready",
            "this test mounts a disk in a namespace of its own, which this system refuses; allowed is, for example, \
             to run as root, with CAP_SYS_ADMIN in a container, or with user namespaces"
        );
        let root = PathBuf::from(format!("/proc/{}/root", keeper.0.id()));
        let folder = root.join(mount_point.path().strip_prefix("/").unwrap());
        Self { keeper, mount_point, folder }
    }

    /// The disk as a folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Takes all the room that is left. What a file's last block, 4 KiB, has left is its own.
    pub fn fill(&self) {
        let mut filler = File::create(self.folder.join(FILLER)).unwrap();
        while filler.write_all(&[0; 1024]).is_ok() {}
    }

    /// Gives the room back.
    pub fn empty(&self) {
        std::fs::remove_file(self.folder.join(FILLER)).unwrap();
    }

    /// Refuses every write from now on, or allows them again. It is `false` where it cannot refuse them
    /// because a program has a file open to write it.
    pub fn set_read_only(&self, read_only: bool) -> bool {
        let options = if read_only { "remount,bind,ro" } else { "remount,bind,rw" };
        let keeper = self.keeper.0.id().to_string();
        let mut command = program("nsenter", "util-linux");
        command.args(["--target", &keeper, "--user", "--mount", "--preserve-credentials"]);
        // Without its options as the system lists them: they name owners whom the namespace does not know.
        command.args(["mount", "--options-source", "disable", "-o", options]).arg(self.mount_point.path());
        command.output().unwrap().status.success()
    }
}

#[test]
fn a_disk_runs_full_and_becomes_read_only_and_is_well_again() {
    let disk = Disk::new();
    let [answers, more] = ["answers", "more"].map(|name| disk.folder().join(name));
    std::fs::write(&answers, "one\n").unwrap();
    disk.fill();
    let error = std::fs::write(&more, "two\n").unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::StorageFull);
    disk.empty();
    std::fs::write(&more, "two\n").unwrap();

    let open = File::options().append(true).open(&answers).unwrap();
    assert!(!disk.set_read_only(true), "a file is open to write it");
    drop(open);
    assert!(disk.set_read_only(true));
    let error = std::fs::write(&more, "three\n").unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::ReadOnlyFilesystem);
    assert!(disk.set_read_only(false));
    std::fs::write(&more, "three\n").unwrap();
    assert_eq!(std::fs::read_to_string(answers).unwrap(), "one\n");
}
