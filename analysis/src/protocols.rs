//! Which sessions may enter one fit: those whose protocols give an answer the same meaning.
//!
//! Name, schedule, rules of convergence and practice may differ, as between laboratories or after a change in mid-study; so may
//! the centres of priors. What is shown, what is asked, how staircases learn and what is excluded must agree.

use scumble_psychophysics::Protocol;
use serde_json::Value;

use crate::Error;

/// Keys that may differ.
const FREE: [&str; 5] = ["name", "schedule", "convergence", "practice", "staircase.prior_ratios"];

/// The first key in which two protocols differ that must agree, with both values; `None` where they may enter one fit.
///
/// # Errors
/// A protocol that JSON cannot hold: a number that is not finite.
pub(crate) fn first_difference(one: &Protocol, other: &Protocol) -> Result<Option<String>, Error> {
    let tree = |protocol| serde_json::to_value(protocol).map_err(|reason| Error::CannotFit(reason.to_string()));
    Ok(difference("", &tree(one)?, &tree(other)?))
}

fn difference(key: &str, one: &Value, other: &Value) -> Option<String> {
    if FREE.contains(&key) || one == other {
        return None;
    }
    let (Value::Object(fields), Value::Object(others)) = (one, other) else {
        let shown = |value: &Value| if value.is_null() { "not given".to_owned() } else { value.to_string() };
        return Some(format!("{key} is {} and {}", shown(one), shown(other)));
    };
    let keys = fields.keys().chain(others.keys().filter(|key| !fields.contains_key(*key)));
    keys.into_iter().find_map(|name| {
        let path = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
        difference(&path, fields.get(name).unwrap_or(&Value::Null), others.get(name).unwrap_or(&Value::Null))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_changes_no_answers_meaning_may_differ_and_anything_else_is_named() {
        let one = Protocol::two_alternative();
        let mut other = one.clone();
        other.name = "in another room".to_owned();
        other.schedule.trials_max = 50;
        other.practice.ratios.clear();
        other.staircase.prior_ratios = vec![2.0, 5.0];
        assert_eq!(first_difference(&one, &other).unwrap(), None);

        other.staircase.guess_probability = 0.4;
        assert_eq!(first_difference(&one, &other).unwrap().unwrap(), "staircase.guess_probability is 0.5 and 0.4");
        other = Protocol { exclusions: Some(scumble_psychophysics::Exclusions::default()), ..one.clone() };
        let found = first_difference(&one, &other).unwrap().unwrap();
        assert_eq!(found, "exclusions is not given and {}");
    }
}
