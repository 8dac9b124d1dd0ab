//! A column of a table: its name, what the JSON beside the table says of it, and the cell that a row has in it.
//!
//! One list of columns makes both files, so that no column is without a description and no description without
//! a column. Text is kept in one cell of one line.

use std::path::Path;

use serde::{
    Serialize,
    ser::{SerializeMap, Serializer},
};

use crate::Error;

/// What stands in a cell; `None` where there is no value.
pub(crate) type Cell = Option<String>;

/// The words of a column and what each means.
pub(crate) type Levels = &'static [(&'static str, &'static str)];

/// Yes and no, for columns that hold nothing else.
pub(crate) const YES_NO: Levels = &[("1", "yes"), ("0", "no")];

/// A column over rows of one kind.
pub(crate) struct Column<R> {
    /// Its header.
    pub(crate) name: &'static str,
    long_name: &'static str,
    description: &'static str,
    units: Option<&'static str>,
    levels: Levels,
    cell: fn(&R) -> Cell,
}

impl<R> Column<R> {
    /// A column without unit and without a fixed set of words.
    pub(crate) fn new(
        name: &'static str,
        long_name: &'static str,
        description: &'static str,
        cell: fn(&R) -> Cell,
    ) -> Self {
        Self { name, long_name, description, units: None, levels: &[], cell }
    }

    /// The same column with the unit of its numbers.
    pub(crate) fn in_units(self, units: &'static str) -> Self {
        Self { units: Some(units), ..self }
    }

    /// The same column with all the words that it may hold.
    pub(crate) fn of_levels(self, levels: Levels) -> Self {
        Self { levels, ..self }
    }
}

/// What the sidecar says of a column, in BIDS' keys.
#[derive(Serialize)]
#[serde(rename_all = "PascalCase")]
struct Described {
    long_name: &'static str,
    description: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    units: Option<&'static str>,
    #[serde(skip_serializing_if = "is_empty", serialize_with = "as_map")]
    levels: Levels,
}

/// The columns' descriptions as the entries of a JSON object, in the order of the table.
///
/// # Errors
/// The serializer's.
pub(crate) fn describe<R, M: SerializeMap>(columns: &[Column<R>], map: &mut M) -> Result<(), M::Error> {
    columns.iter().try_for_each(|column| {
        let Column { long_name, description, units, levels, .. } = *column;
        map.serialize_entry(column.name, &Described { long_name, description, units, levels })
    })
}

/// A sidecar that holds descriptions of columns and nothing else.
pub(crate) struct Sidecar<'a, R>(pub(crate) &'a [Column<R>]);

impl<R> Serialize for Sidecar<'_, R> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        describe(self.0, &mut map)?;
        map.end()
    }
}

/// The table as BIDS wants it: tabs between the cells, a header, `n/a` for what is missing. `name` is for
/// messages.
///
/// # Errors
/// The writer's.
pub(crate) fn tsv<R>(name: &Path, columns: &[Column<R>], rows: &[R]) -> Result<String, Error> {
    separated(name, columns, rows, b'\t', "n/a")
}

/// The table with commas between the cells, a header, and nothing for what is missing.
///
/// # Errors
/// The writer's.
pub(crate) fn csv<R>(name: &Path, columns: &[Column<R>], rows: &[R]) -> Result<String, Error> {
    separated(name, columns, rows, b',', "")
}

fn separated<R>(name: &Path, columns: &[Column<R>], rows: &[R], delimiter: u8, missing: &str) -> Result<String, Error> {
    let failed = |error: csv::Error| Error::io(name)(error.into());
    let mut writer = csv::WriterBuilder::new().delimiter(delimiter).from_writer(Vec::new());
    writer.write_record(columns.iter().map(|column| column.name)).map_err(failed)?;
    for row in rows {
        let cells =
            columns.iter().map(|column| (column.cell)(row).map_or(missing.to_owned(), |text| in_one_line(&text)));
        writer.write_record(cells).map_err(failed)?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(error.into_error().into()))?;
    String::from_utf8(bytes).map_err(|error| Error::File { path: name.into(), reason: error.to_string() })
}

/// The text with its tabs, line ends, other control characters and backslashes as escapes: `\t`, `\n`, `\r`,
/// `\u{…}`, `\\`. Not every reader of BIDS tables understands quotes around them.
fn in_one_line(text: &str) -> String {
    let ends_line = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}');
    let escaped = |c: char| if c == '\\' || ends_line(c) { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(escaped).collect()
}

/// A number in the fewest digits that give it back.
pub(crate) fn number(value: f64) -> Cell {
    Some(value.to_string())
}

/// 1 or 0, described by [`YES_NO`].
pub(crate) fn flag(value: bool) -> Cell {
    Some(u8::from(value).to_string())
}

/// The word by which a value stands in the record; `None` for a value that is not a word there.
pub(crate) fn word(value: impl Serialize) -> Cell {
    serde_json::to_value(value).ok()?.as_str().map(str::to_owned)
}

fn is_empty(levels: &Levels) -> bool {
    levels.is_empty()
}

fn as_map<S: Serializer>(levels: &Levels, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(levels.iter().copied())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_and_its_sidecar_have_the_same_columns() {
        let columns = [
            Column::<f64>::new("length", "Length", "How long", |row| number(*row)).in_units("m"),
            Column::new("long", "Long", "Whether above 0", |row| (*row > 0.0).then(|| "1".to_owned()))
                .of_levels(YES_NO),
        ];
        assert_eq!(
            tsv(Path::new("a.tsv"), &columns, &[0.5, -1e-7]).unwrap(),
            "length\tlong\n0.5\t1\n-0.0000001\tn/a\n"
        );
        let sidecar = serde_json::to_string(&Sidecar(&columns)).unwrap();
        let expected = concat!(
            r#"{"length":{"LongName":"Length","Description":"How long","Units":"m"},"#,
            r#""long":{"LongName":"Long","Description":"Whether above 0","Levels":{"1":"yes","0":"no"}}}"#
        );
        assert_eq!(sidecar, expected);
    }

    #[test]
    fn a_hostile_text_stays_one_cell_of_one_line() {
        let hostile = "a\tb\r\nc \"quoted\" \\ d\u{2028}e\u{7}";
        let columns = [Column::<&str>::new("note", "Note", "A note", |row| Some((*row).to_owned()))];
        let table = tsv(Path::new("a.tsv"), &columns, &[hostile]).unwrap();
        assert_eq!(table.lines().count(), 2);
        assert!(!table.contains('\t') && !table.contains('\u{2028}'));
        let mut reader = csv::ReaderBuilder::new().delimiter(b'\t').from_reader(table.as_bytes());
        let cell = reader.records().next().unwrap().unwrap()[0].to_owned();
        assert_eq!(cell, r#"a\tb\r\nc "quoted" \\ d\u{2028}e\u{7}"#);
    }
}
