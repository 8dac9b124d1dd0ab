//! In English.

use super::SetupWords;
use crate::setup::FolderProblem;

pub(in crate::words) const ENGLISH: SetupWords = SetupWords { go_on: "Go on", folder_problem };

fn folder_problem(problem: &FolderProblem) -> String {
    match problem {
        FolderProblem::NotAFolder(path) => format!("{} is a file; allowed is a folder", path.display()),
        FolderProblem::NotWritable { path, reason } => {
            format!("{}: cannot be written: {reason}; allowed is a folder that can", path.display())
        }
        FolderProblem::Protocol(error) => error.to_string(),
        FolderProblem::Differs { file, name, asked, asked_name } => format!(
            "the study has the protocol {name:?} ({}), and --protocol {asked} is {asked_name:?} with other parameters; \
             leave --protocol out to go on with the study's, or give another folder for a new study",
            file.display()
        ),
    }
}
