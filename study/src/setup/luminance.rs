//! `luminance.csv`: what somebody measured of the study's display with a photometer.
//!
//! ```text
//! level,luminance_cd_m2
//! 0,0.21
//! 128,24.4
//! 255,112.0
//! ```

use std::io::ErrorKind;
use std::path::Path;

use scumble_stimuli::Transfer;

/// Name of the table in the folder of a study.
const LUMINANCE_FILE: &str = "luminance.csv";

const COLUMNS: &str = "level,luminance_cd_m2";

/// A table that describes a display: levels and their luminance in candela per square metre.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LuminanceTable {
    /// Rows from level 0 to level 255, both columns increasing.
    pub(crate) rows: Vec<(u8, f64)>,
    /// Light of each of the 256 levels.
    pub(crate) transfer: Transfer,
}

impl LuminanceTable {
    /// The table in the folder of a study, `None` where there is none.
    ///
    /// The error names the file, the line where one is at fault, and what is allowed, in English.
    pub(crate) fn read(study: &Path) -> Result<Option<Self>, String> {
        let file = study.join(LUMINANCE_FILE);
        match std::fs::read_to_string(&file) {
            Ok(text) => Self::parse(&text).map(Some).map_err(|problem| format!("{}{problem}", file.display())),
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => Ok(None),
            Err(error) => Err(format!("{}: {error}; allowed is text in UTF-8", file.display())),
        }
    }

    /// The table of a text; the error begins with `:LINE: ` or `: `.
    fn parse(text: &str) -> Result<Self, String> {
        // Spreadsheets put a byte order mark before their text.
        let mut lines = text.trim_start_matches('\u{feff}').lines().enumerate();
        let header = lines.next().map_or("", |(_, line)| line.trim());
        if header != COLUMNS {
            return Err(format!(":1: the columns are {header:?}; allowed is {COLUMNS:?}"));
        }
        let mut rows = Vec::new();
        for (index, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
            let row = line.split_once(',').and_then(|(level, luminance)| {
                Some((level.trim().parse::<u8>().ok()?, luminance.trim().parse::<f64>().ok()?))
            });
            rows.push(row.ok_or_else(|| {
                format!(
                    ":{}: {line:?}; allowed is a level from 0 to 255, a comma, and a luminance such as 24.4",
                    index + 1
                )
            })?);
        }
        match Transfer::from_table(&rows) {
            Ok(transfer) => Ok(Self { rows, transfer }),
            Err(error) => Err(format!(": {error}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_with_the_light_between_its_rows() {
        let table = LuminanceTable::parse("level,luminance_cd_m2\r\n0,0.5\r\n128, 25\r\n255,100.5\r\n\r\n").unwrap();
        assert_eq!(table.rows, [(0, 0.5), (128, 25.0), (255, 100.5)]);
        assert!((table.transfer.light(128) - 0.245).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_table_is_named_by_its_line() {
        let problem = |text: &str| LuminanceTable::parse(text).unwrap_err();
        assert!(problem("").starts_with(":1: the columns are \"\""));
        assert!(problem("level;luminance\n").starts_with(":1: "));
        for (row, at_fault) in [("256,9", ":3: "), ("1;9", ":3: "), ("10,\"3,5\"", ":3: ")] {
            let text = format!("{COLUMNS}\n0,0.2\n{row}\n255,100\n");
            assert!(problem(&text).starts_with(at_fault), "{}", problem(&text));
        }
        assert!(problem(&format!("{COLUMNS}\n0,0.2\n200,100\n")).contains("from level 0 to level 200"));
        assert!(problem(&format!("{COLUMNS}\n0,5\n255,4\n")).contains("increase"));
    }

    #[test]
    fn a_study_without_a_table_has_none() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(LuminanceTable::read(folder.path()), Ok(None));
        assert_eq!(LuminanceTable::read(&folder.path().join("not there")), Ok(None));
        std::fs::write(folder.path().join(LUMINANCE_FILE), "level\n").unwrap();
        let problem = LuminanceTable::read(folder.path()).unwrap_err();
        assert!(problem.contains("luminance.csv:1: "), "{problem}");
    }
}
