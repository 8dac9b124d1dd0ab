//! Checks the lines of an OBJ file before it is loaded, because only here a problem still has a line number.
//!
//! Checked: coordinates are finite `f32` numbers, a face has three corners or more and refers only to vertices and normals that the file has.
//! Indices count from 1; negative ones count back from the last vertex given so far (Wavefront, *Object Files*, B1).

/// The first problem of an OBJ file.
#[derive(Debug, PartialEq)]
pub struct LineProblem {
    /// Counted from 1.
    pub line: usize,
    /// What was found.
    pub problem: String,
    /// What is allowed.
    pub allowed: &'static str,
}

/// How many `v`, `vt`, `vn` lines there are.
#[derive(Clone, Copy, Default)]
struct Counts([usize; 3]);

const KEYWORDS: [&str; 3] = ["v", "vt", "vn"];
const NAMES: [&str; 3] = ["vertex", "texture coordinate", "normal"];
const ALLOWED_NUMBERS: &str = "allowed are finite numbers, three of them";
const ALLOWED_CORNERS: &str = "allowed are three corners or more";
const ALLOWED_INDICES: &str = "allowed are indices from 1 to the number given, or negative ones that count back";

/// Checks all lines; the first problem ends the check.
pub fn check(text: &str) -> Result<(), LineProblem> {
    let mut total = Counts::default();
    for keyword in text.lines().filter_map(first_word) {
        total.add(keyword);
    }

    let mut so_far = Counts::default();
    for (index, line) in text.lines().enumerate() {
        let Some(keyword) = first_word(line) else {
            continue;
        };
        so_far.add(keyword);
        let words = line.split_whitespace().skip(1);
        let checked = match keyword {
            "v" | "vn" => check_numbers(words),
            "f" => check_face(words, so_far, total),
            _ => Ok(()),
        };
        checked.map_err(|(problem, allowed)| LineProblem { line: index + 1, problem, allowed })?;
    }
    Ok(())
}

type Checked = Result<(), (String, &'static str)>;

impl Counts {
    fn add(&mut self, keyword: &str) {
        if let Some(kind) = KEYWORDS.iter().position(|&k| k == keyword) {
            self.0[kind] += 1;
        }
    }
}

fn first_word(line: &str) -> Option<&str> {
    line.split_whitespace().next()
}

fn check_numbers<'a>(words: impl Iterator<Item = &'a str>) -> Checked {
    let mut count = 0;
    for word in words.take(3) {
        if !word.parse::<f32>().is_ok_and(f32::is_finite) {
            return Err((format!("coordinate '{word}'"), ALLOWED_NUMBERS));
        }
        count += 1;
    }
    if count < 3 {
        return Err((format!("{count} coordinates"), ALLOWED_NUMBERS));
    }
    Ok(())
}

fn check_face<'a>(words: impl Iterator<Item = &'a str>, so_far: Counts, total: Counts) -> Checked {
    let mut corners = 0;
    for word in words {
        corners += 1;
        for (kind, index) in word.split('/').enumerate() {
            // `1//3` leaves the texture coordinate out.
            if index.is_empty() && kind > 0 {
                continue;
            }
            let in_range = match index.parse::<i64>() {
                Ok(i) if kind < 3 && i > 0 => i.unsigned_abs() <= total.0[kind] as u64,
                Ok(i) if kind < 3 && i < 0 => i.unsigned_abs() <= so_far.0[kind] as u64,
                _ => false,
            };
            if !in_range {
                let name = NAMES.get(kind).copied().unwrap_or("fourth");
                let given = total.0.get(kind).copied().unwrap_or(0);
                let problem = format!("{name} index '{index}' where {given} are given");
                return Err((problem, ALLOWED_INDICES));
            }
        }
    }
    if corners < 3 {
        return Err((format!("a face of {corners} corners"), ALLOWED_CORNERS));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem_of(text: &str) -> (usize, String) {
        let problem = check(text).unwrap_err();
        (problem.line, problem.problem)
    }

    #[test]
    fn every_form_of_a_face_is_allowed() {
        let text = "v 0 0 0\nv 1 0 0 1\nv 0 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n\
            f 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\nf -3 -2 -1\n# f 9 9 9\n";
        assert_eq!(check(text), Ok(()));
    }

    #[test]
    fn problems_are_found_at_their_line() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        let face = |f: &str| problem_of(&format!("{vertices}f {f}\n"));
        assert_eq!(face("1 2 4").0, 4);
        assert_eq!(face("1 2"), (4, "a face of 2 corners".to_owned()));
        assert_eq!(face("0 1 2").0, 4);
        assert_eq!(face("-4 1 2").0, 4);
        assert_eq!(face("1 2 x").0, 4);
        assert_eq!(face("1/1 2/1 3/1").1, "texture coordinate index '1' where 0 are given");
        assert_eq!(face("1//1 2//1 3//1").1, "normal index '1' where 0 are given");
        assert_eq!(face("1/2/3/4 2 3").0, 4);
        assert_eq!(problem_of("# head\nv 0 nan 0\n"), (2, "coordinate 'nan'".to_owned()));
        assert_eq!(problem_of("v 0 1e39 0\n"), (1, "coordinate '1e39'".to_owned()));
        assert_eq!(problem_of("v 0 1\n"), (1, "2 coordinates".to_owned()));
    }
}
