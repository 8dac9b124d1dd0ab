//! Labels of BIDS file names: letters and digits alone, unique whatever a file system makes of capitals.
//!
//! A label is the name without its other characters: `p-07_a` becomes `p07a`. Where two names would share a
//! label, ignoring case, the later one in the list gets `x2`, the next one `x3`: `p07`, `p-07`, `P07` become
//! `p07`, `p07x2`, `P07x3`. A name without letter or digit becomes `x`.

use std::collections::BTreeSet;

/// A label for each name, in the order of the names.
pub(super) fn unique_labels<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut taken = BTreeSet::new();
    names.into_iter().map(|name| free_label(name, &mut taken)).collect()
}

/// The first label of a name that is not taken; takes it.
fn free_label(name: &str, taken: &mut BTreeSet<String>) -> String {
    let mut base: String = name.chars().filter(char::is_ascii_alphanumeric).collect();
    if base.is_empty() {
        base.push('x');
    }
    let mut label = base.clone();
    let mut place = 2;
    while !taken.insert(label.to_ascii_lowercase()) {
        label = format!("{base}x{place}");
        place += 1;
    }
    label
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_letter_or_digit_is_left_out() {
        assert_eq!(
            unique_labels(["p-07_a", "sim-0001", "yes-no", "-_", "größe 2"]),
            ["p07a", "sim0001", "yesno", "x", "gre2"]
        );
    }

    #[test]
    fn names_that_would_share_a_label_get_labels_of_their_own() {
        let names = ["p07", "p-07", "P07", "p07x2", "p_07", "-", "_"];
        let labels = unique_labels(names);
        assert_eq!(labels, ["p07", "p07x2", "P07x3", "p07x2x2", "p07x4", "x", "xx2"]);
        let lower: BTreeSet<_> = labels.iter().map(|label| label.to_lowercase()).collect();
        assert_eq!(lower.len(), names.len());
    }
}
