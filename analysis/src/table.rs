//! Reading CSV tables so that every complaint names the file and the line.

use std::path::Path;

use serde::de::DeserializeOwned;

use crate::Error;

/// Hands every row of a table with the columns `header` (more may follow) to `take`, which returns
/// what is wrong with a row.
pub(crate) fn read_rows<Row: DeserializeOwned>(
    path: &Path,
    header: &[&str],
    mut take: impl FnMut(Row) -> Result<(), String>,
) -> Result<(), Error> {
    let text = std::fs::read_to_string(path).map_err(Error::io(path))?;
    let complaint = |line, reason| Error::Table { path: path.to_path_buf(), line, reason };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());

    let found = reader.headers().map_err(|error| complaint(1, csv_reason(&error)))?.clone();
    if let Some(missing) = header.iter().find(|name| !found.iter().any(|column| column == **name)) {
        let columns: Vec<&str> = found.iter().collect();
        let (found, wanted) = (columns.join(","), header.join(","));
        let reason = format!("column {missing} is missing: found \"{found}\", wanted \"{wanted}\"");
        return Err(complaint(1, reason));
    }

    let mut record = csv::StringRecord::new();
    let mut rows = 0_u64;
    loop {
        let line = reader.position().line();
        let more = reader.read_record(&mut record);
        match more {
            Ok(false) => break,
            Ok(true) => rows += 1,
            Err(error) => return Err(complaint(line, csv_reason(&error))),
        }
        let line = record.position().map_or(line, csv::Position::line);
        let row = record.deserialize(Some(&found)).map_err(|error| complaint(line, csv_reason(&error)))?;
        take(row).map_err(|reason| complaint(line, reason))?;
    }
    if rows == 0 {
        return Err(complaint(2, "the table has no row".to_owned()));
    }
    Ok(())
}

/// The reason of a CSV error without its own position, which the caller adds.
fn csv_reason(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => err.to_string(),
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("the row has {len} cells; the header has {expected_len}")
        }
        _ => error.to_string(),
    }
}
