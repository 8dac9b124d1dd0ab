//! In German.

use super::SetupWords;
use crate::setup::FolderProblem;

pub(in crate::words) const GERMAN: SetupWords = SetupWords { go_on: "Weiter", folder_problem };

fn folder_problem(problem: &FolderProblem) -> String {
    match problem {
        FolderProblem::NotAFolder(path) => format!("{} ist eine Datei; erlaubt ist ein Ordner", path.display()),
        FolderProblem::NotWritable { path, reason } => {
            format!("{}: lässt sich nicht schreiben ({reason}); erlaubt ist ein beschreibbarer Ordner", path.display())
        }
        // The readers of files speak English.
        FolderProblem::Protocol(error) => error.to_string(),
        FolderProblem::Differs { file, name, asked, asked_name } => format!(
            "Die Studie hat das Protokoll {name:?} ({}), --protocol {asked} ist {asked_name:?} mit anderen Parametern. \
             Lassen Sie --protocol weg, um mit dem der Studie weiterzumachen, oder wählen Sie für eine neue Studie \
             einen anderen Ordner.",
            file.display()
        ),
    }
}
