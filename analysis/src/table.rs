//! Reading tables of numbers so that every complaint names the file, the line and what is allowed.

use std::path::Path;

use crate::Error;

/// A file's text.
///
/// # Errors
/// The system's refusal, or the first line that is not UTF-8.
pub(crate) fn read_text(path: &Path) -> Result<String, Error> {
    let bytes = std::fs::read(path).map_err(Error::io(path))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count() as u64;
        let reason = "bytes that are not UTF-8; allowed is text in UTF-8".to_owned();
        Error::Table { path: path.to_path_buf(), line, reason }
    })
}

/// Hands the numbers of every row in the columns `header` (others may stand beside them) and its line
/// to `take`, which returns what is wrong with a row. Empty lines are skipped.
pub(crate) fn read_rows<const COLUMNS: usize>(
    path: &Path,
    header: [&str; COLUMNS],
    mut take: impl FnMut(u64, [f64; COLUMNS]) -> Result<(), String>,
) -> Result<(), Error> {
    let text = read_text(path)?;
    let complaint = |line, reason| Error::Table { path: path.to_path_buf(), line, reason };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());

    let found = reader.headers().map_err(|error| complaint(1, csv_reason(&error)))?;
    let places = places(found, header).map_err(|reason| complaint(1, reason))?;

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
        numbers(&record, header, places)
            .and_then(|numbers| take(line, numbers))
            .map_err(|reason| complaint(line, reason))?;
    }
    if rows == 0 {
        return Err(complaint(2, "the table has no row; allowed is one row or more".to_owned()));
    }
    Ok(())
}

/// Where the columns stand; each must be there once.
fn places<const COLUMNS: usize>(
    found: &csv::StringRecord,
    header: [&str; COLUMNS],
) -> Result<[usize; COLUMNS], String> {
    let mut places = [0; COLUMNS];
    for (name, place) in header.into_iter().zip(&mut places) {
        let mut all = found.iter().enumerate().filter(|(_, column)| *column == name).map(|(index, _)| index);
        *place = all.next().ok_or_else(|| {
            let columns: Vec<&str> = found.iter().collect();
            format!("column {name} is missing: found {:?}; allowed is {:?}", columns.join(","), header.join(","))
        })?;
        if all.next().is_some() {
            return Err(format!("column {name} stands there twice; allowed is once"));
        }
    }
    Ok(places)
}

fn numbers<const COLUMNS: usize>(
    record: &csv::StringRecord,
    header: [&str; COLUMNS],
    places: [usize; COLUMNS],
) -> Result<[f64; COLUMNS], String> {
    let mut numbers = [0.0; COLUMNS];
    for ((name, place), number) in header.into_iter().zip(places).zip(&mut numbers) {
        let cell = record.get(place).unwrap_or_default();
        *number = cell.parse().map_err(|_| format!("{name} is {}; allowed is a number", quoted(cell)))?;
    }
    Ok(numbers)
}

/// A cell on one line, and not longer than a line.
fn quoted(cell: &str) -> String {
    let short: String = cell.chars().take(40).collect();
    let dots = if short.len() < cell.len() { " …" } else { "" };
    format!("{short:?}{dots}")
}

/// The reason of a CSV error without its own position, which the caller adds.
fn csv_reason(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("the row has {len} cells; allowed are {expected_len}, as in the header")
        }
        _ => error.to_string(),
    }
}
