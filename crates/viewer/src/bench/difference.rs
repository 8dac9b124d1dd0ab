//! Where two records differ, by the path of the key: `options.frames: 15 there, 20 here`.

use anyhow::Result;
use serde::Serialize;
use serde_json::Value;

/// Every place where they differ, in the order of the keys.
pub fn differences(there: &impl Serialize, here: &impl Serialize) -> Result<Vec<String>> {
    let mut found = Vec::new();
    walk("", &serde_json::to_value(there)?, &serde_json::to_value(here)?, &mut found);
    Ok(found)
}

fn walk(path: &str, there: &Value, here: &Value, found: &mut Vec<String>) {
    if let (Value::Object(left), Value::Object(right)) = (there, here) {
        for (key, value) in left {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            walk(&path, value, right.get(key).unwrap_or(&Value::Null), found);
        }
    } else if there != here {
        found.push(format!("{path}: {there} there, {here} here"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn differences_are_named_by_their_path() {
        let there = json!({ "a": { "b": 1, "c": [1, 2] }, "d": "x" });
        let here = json!({ "a": { "b": 2, "c": [1, 2] }, "d": "y" });
        assert_eq!(differences(&there, &here).unwrap(), ["a.b: 1 there, 2 here", "d: \"x\" there, \"y\" here"]);
        assert!(differences(&there, &there).unwrap().is_empty());
    }
}
