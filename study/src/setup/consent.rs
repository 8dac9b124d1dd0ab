//! The text that a participant agrees to, from a file in the folder of the study.

use std::path::{Path, PathBuf};

use scumble_psychophysics::Language;
use sha2::{Digest, Sha256};

/// Name of the text for every language.
const ANY_LANGUAGE: &str = "consent.txt";

/// A consent text as it lies on disk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ConsentText {
    /// What is shown.
    pub(crate) text: String,
    /// SHA-256 of the file as 64 hex digits: what `sha256sum` says.
    pub(crate) sha256: String,
}

/// Why nobody can be asked for consent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ConsentProblem {
    /// There is a text, and none in the participant's language: a session without consent would begin.
    OtherLanguage {
        /// The text that there is.
        found: PathBuf,
        /// The name that is looked for.
        missing: &'static str,
    },
    /// The file cannot be read, or holds no text.
    Unreadable { file: PathBuf, reason: String },
}

impl ConsentText {
    /// The text of a study for a participant who is spoken to in `language`: `consent.en.txt` or
    /// `consent.de.txt`, else `consent.txt`; `None` where the study has no consent text at all.
    pub(crate) fn read(study: &Path, language: Language) -> Result<Option<Self>, ConsentProblem> {
        let [own, other] = match language {
            Language::English => ["consent.en.txt", "consent.de.txt"],
            Language::German => ["consent.de.txt", "consent.en.txt"],
        };
        let there = |name: &&str| study.join(name).exists();
        match [own, ANY_LANGUAGE].into_iter().find(there) {
            Some(name) => Self::of_file(&study.join(name)).map(Some),
            None if there(&other) => Err(ConsentProblem::OtherLanguage { found: study.join(other), missing: own }),
            None => Ok(None),
        }
    }

    fn of_file(file: &Path) -> Result<Self, ConsentProblem> {
        let unreadable = |reason: String| ConsentProblem::Unreadable { file: file.into(), reason };
        let bytes = std::fs::read(file).map_err(|error| unreadable(error.to_string()))?;
        let sha256 = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        let text = String::from_utf8(bytes).map_err(|error| unreadable(error.utf8_error().to_string()))?;
        let text = text.trim_start_matches('\u{feff}').to_owned();
        if text.trim().is_empty() {
            return Err(unreadable("empty".to_owned()));
        }
        Ok(Self { text, sha256 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn study(files: &[(&str, &[u8])]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in files {
            std::fs::write(folder.path().join(name), bytes).unwrap();
        }
        folder
    }

    #[test]
    fn the_hash_is_that_of_the_file() {
        let study = study(&[("consent.txt", b"abc")]);
        let consent = ConsentText::read(study.path(), Language::English).unwrap().unwrap();
        // FIPS 180-2, appendix B.1.
        assert_eq!(consent.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!(consent.text, "abc");
    }

    #[test]
    fn each_language_has_its_own_text_or_the_one_for_all() {
        let both = study(&[("consent.en.txt", b"I agree"), ("consent.de.txt", "Ich möchte".as_bytes())]);
        let text = |study: &Path, language| ConsentText::read(study, language).unwrap().map(|consent| consent.text);
        assert_eq!(text(both.path(), Language::English).as_deref(), Some("I agree"));
        assert_eq!(text(both.path(), Language::German).as_deref(), Some("Ich möchte"));
        let all = study(&[("consent.txt", b"all"), ("consent.de.txt", b"de")]);
        assert_eq!(text(all.path(), Language::English).as_deref(), Some("all"));
        assert_eq!(text(study(&[]).path(), Language::English), None);
    }

    #[test]
    fn a_text_in_the_other_language_alone_does_not_mean_that_nobody_is_asked() {
        let study = study(&[("consent.de.txt", b"nur Deutsch")]);
        let found = study.path().join("consent.de.txt");
        assert_eq!(
            ConsentText::read(study.path(), Language::English),
            Err(ConsentProblem::OtherLanguage { found, missing: "consent.en.txt" })
        );
    }

    #[test]
    fn a_text_that_nobody_can_read_is_a_problem() {
        for bytes in [b" \n".as_slice(), b"\xff\xfe"] {
            let study = study(&[("consent.txt", bytes)]);
            let read = ConsentText::read(study.path(), Language::English);
            assert!(matches!(read, Err(ConsentProblem::Unreadable { .. })), "{read:?}");
        }
    }
}
