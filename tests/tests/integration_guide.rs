//! The tutorial stays as short as it is said to be: lines that a renderer changes to take the drop-in.

use std::collections::HashMap;

const CHANGED_LINES_MAX: usize = 30;

fn example(name: &str) -> String {
    let path = format!("{}/../crates/scumble/examples/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Lines of `after` that `before` has not, as often as they are there; comments do not run.
fn new_lines(before: &str, after: &str) -> usize {
    let code = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with("//");
    let mut known: HashMap<&str, usize> = HashMap::new();
    for line in before.lines().filter(code) {
        *known.entry(line).or_default() += 1;
    }
    let mut count = 0;
    for line in after.lines().filter(code) {
        match known.get_mut(line) {
            Some(left) if *left > 0 => *left -= 1,
            _ => count += 1,
        }
    }
    count
}

#[test]
fn a_renderer_changes_at_most_thirty_lines() {
    let count: usize = [("integrate_before.rs", "integrate.rs"), ("integrate_before.wgsl", "minimal.wgsl")]
        .map(|(before, after)| new_lines(&example(before), &example(after)))
        .iter()
        .sum();
    assert!((10..=CHANGED_LINES_MAX).contains(&count), "{count} lines");
}

#[test]
fn lines_are_counted_as_often_as_they_are_there() {
    assert_eq!(new_lines("a\nb\nb\n", "b\nb\nb\nc\n// d\n\n"), 2);
}
