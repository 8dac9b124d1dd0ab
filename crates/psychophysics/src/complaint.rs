//! A complaint of a deserialiser in the words of someone who fills in a file: which key, what was found
//! and what is allowed.
//!
//! serde says "FOUND, expected ALLOWED" in the names of Rust's types; the key comes from
//! `serde_path_to_error`.

/// Most characters of a damaged file that a message quotes: two lines of a terminal.
const QUOTE_LENGTH_MAX: usize = 160;

/// What was found and what is allowed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Complaint {
    pub(crate) found: String,
    pub(crate) allowed: String,
}

impl Complaint {
    /// The complaint `message` about the value of `key` (dotted; `.` for the whole file). `otherwise` is
    /// allowed where the message does not say what is.
    pub(crate) fn new(key: &str, message: &str, otherwise: &str) -> Self {
        // A question mark stands for a key that could not be read.
        let key = key.trim_end_matches(['.', '?']);
        if let Some(name) = message.strip_prefix("missing field ") {
            let name = joined(key, bare(name));
            return Self { found: format!("no key {name}"), allowed: format!("the key {name} with a value") };
        }
        if let Some(name) = message.strip_prefix("duplicate field ") {
            return Self { found: format!("{} twice", joined(key, bare(name))), allowed: "each key once".into() };
        }
        // Another library's sentence about a value may hold the word too. From the right, as the found text
        // may hold anything.
        let is_of_serde = ["invalid ", "unknown "].iter().any(|start| message.starts_with(start));
        let parts = message.rsplit_once(", expected ").filter(|_| is_of_serde || key.is_empty());
        let (found, expected) = match parts {
            Some((found, expected)) => (found, in_plain_words(expected)),
            None => (in_plain_syntax(message), otherwise.to_owned()),
        };
        if let Some(name) = found.strip_prefix("unknown field ") {
            let allowed = with_unit(bare(name), &expected).unwrap_or(expected);
            return Self { found: quoted(&format!("the unknown key {}", joined(key, bare(name)))), allowed };
        }
        let prefixes = ["invalid type: ", "invalid value: ", "unknown variant "];
        let value = prefixes.iter().find_map(|prefix| found.strip_prefix(prefix));
        let found = match (key, value) {
            ("", _) => value.unwrap_or(found).to_owned(),
            (key, Some(value)) => format!("{key} is {value}"),
            (key, None) => format!("{key}: {found}"),
        };
        Self { found: quoted(&found), allowed: expected }
    }
}

/// `text` with what no terminal shows written out, and cut where it is long.
pub(crate) fn quoted(text: &str) -> String {
    let shown = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    let whole: String = text.chars().take(QUOTE_LENGTH_MAX + 1).map(shown).collect();
    let mut quote: String = whole.chars().take(QUOTE_LENGTH_MAX).collect();
    if quote != whole {
        quote.push('…');
    }
    quote
}

/// The allowed key that `name` is without its unit, or with another one: `width` for `width_px`.
fn with_unit(name: &str, allowed: &str) -> Option<String> {
    let keys = || allowed.trim_start_matches("one of ").split([',', ' ']).filter(|key| key.contains('_'));
    let stem_of = |key: &'_ str| key.rsplit_once('_').map_or(key.to_owned(), |(stem, _)| stem.to_owned());
    let is_stem = |key: &&str| stem_of(key) == name;
    let shares_stem = |key: &&str| stem_of(key) == stem_of(name);
    keys().find(is_stem).or_else(|| keys().find(shares_stem)).map(|key| format!("{key}, the whole name with its unit"))
}

/// What serde expects, without the names of Rust's types.
fn in_plain_words(expected: &str) -> String {
    match expected {
        "f64" => "a number".into(),
        "u32" => "a whole number from 0 to 4294967295".into(),
        "u64" => "a whole number from 0 to 18446744073709551615".into(),
        "a boolean" => "true or false".into(),
        "a sequence" => "a list".into(),
        "string or map" => "a word in quotes".into(),
        _ if expected.starts_with("struct ") => "a group of keys with values".into(),
        _ => expected.replace('`', ""),
    }
}

/// What a reader of JSON found, without its abbreviations.
fn in_plain_syntax(message: &str) -> &str {
    match message {
        "expected value" => "no value of JSON",
        "EOF while parsing a value" => "nothing where a value must stand",
        _ if message.starts_with("EOF while parsing") => "an end before everything is closed",
        _ => message,
    }
}

/// A name without serde's quotes.
fn bare(name: &str) -> &str {
    name.trim_matches('`')
}

/// `name` within `key`, unless `key` ends with it already.
fn joined(key: &str, name: &str) -> String {
    match key {
        "" => name.into(),
        _ if key == name || key.ends_with(&format!(".{name}")) => key.into(),
        _ => format!("{key}.{name}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(key: &str, message: &str) -> (String, String) {
        let Complaint { found, allowed } = Complaint::new(key, message, "something else");
        (found, allowed)
    }

    #[test]
    fn a_message_of_serde_becomes_what_was_found_and_what_is_allowed() {
        let cases = [
            (
                "a.b",
                "invalid type: string \"x, expected y\", expected f64",
                "a.b is string \"x, expected y\"",
                "a number",
            ),
            (
                "a.b",
                "invalid value: integer `-1`, expected u32",
                "a.b is integer `-1`",
                "a whole number from 0 to 4294967295",
            ),
            ("a", "missing field `b`", "no key a.b", "the key a.b with a value"),
            (".", "missing field `b`", "no key b", "the key b with a value"),
            ("a", "duplicate field `b`", "a.b twice", "each key once"),
            ("a", "unknown variant `x`, expected `y` or `z`", "a is `x`", "y or z"),
            ("a", "unknown field `x`, expected one of `y`, `z`", "the unknown key a.x", "one of y, z"),
            ("a.x", "unknown field `x`, expected `y`", "the unknown key a.x", "y"),
            (".", "EOF while parsing a list", "an end before everything is closed", "something else"),
            ("a.?", "expected value", "a: no value of JSON", "something else"),
            ("a", "no digit, expected 0-9 but got y", "a: no digit, expected 0-9 but got y", "something else"),
        ];
        for (key, message, found, allowed) in cases {
            assert_eq!(told(key, message), (found.into(), allowed.into()));
        }
    }

    #[test]
    fn a_key_without_its_unit_or_with_another_one_is_told_its_whole_name() {
        for name in ["width", "width_cm"] {
            let message = format!("unknown field `{name}`, expected one of `width_px`, `height_px`");
            assert_eq!(told("pictures", &message).1, "width_px, the whole name with its unit");
        }
        let message = "unknown field `prior_sd`, expected one of `prior_ratios`, `prior_sd_log10`";
        assert_eq!(told("staircase", message).1, "prior_sd_log10, the whole name with its unit");
    }

    #[test]
    fn a_quote_is_short_and_shows_what_no_terminal_does() {
        assert_eq!(quoted("a\0b\n"), "a\\u{0}b\\n");
        assert_eq!(quoted(&"é".repeat(1000)).chars().count(), QUOTE_LENGTH_MAX + 1);
    }
}
