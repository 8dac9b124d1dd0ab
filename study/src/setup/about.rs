//! What a participant may say about themselves; nothing has to be said.

use scumble_psychophysics::{Demographics, Experience, Gender, Handedness, Vision};

/// Ages in years that are no slip of the fingers.
const AGES: std::ops::RangeInclusive<u32> = 5..=120;

/// The answers so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct About {
    /// Age in years as it was typed.
    pub(crate) age: String,
    pub(crate) gender: Option<Gender>,
    pub(crate) handedness: Option<Handedness>,
    pub(crate) vision: Option<Vision>,
    pub(crate) graphics_experience: Option<Experience>,
}

impl About {
    /// The age, `None` where none was typed; the error holds what is no age.
    pub(crate) fn age_years(&self) -> Result<Option<u32>, String> {
        match self.age.trim() {
            "" => Ok(None),
            typed => match typed.parse() {
                Ok(years) if AGES.contains(&years) => Ok(Some(years)),
                _ => Err(typed.to_owned()),
            },
        }
    }

    /// The answers for the record, `None` where every question was left empty; the error as
    /// [`About::age_years`].
    pub(crate) fn demographics(&self) -> Result<Option<Demographics>, String> {
        let Self { gender, handedness, vision, graphics_experience, .. } = *self;
        let age_years = self.age_years()?;
        let answered = Demographics { age_years, gender, handedness, vision, graphics_experience };
        let nothing = Self { age: String::new(), ..self.clone() } == Self::default() && age_years.is_none();
        Ok((!nothing).then_some(answered))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_says_nothing_leaves_no_record() {
        assert_eq!(About::default().demographics(), Ok(None));
        assert_eq!(About { age: "  ".into(), ..About::default() }.demographics(), Ok(None));
    }

    #[test]
    fn one_answer_is_a_record_with_the_others_empty() {
        let answered = About { vision: Some(Vision::Corrected), ..About::default() }.demographics().unwrap().unwrap();
        assert_eq!((answered.vision, answered.gender, answered.age_years), (Some(Vision::Corrected), None, None));
        let aged = About { age: " 27 ".into(), ..About::default() }.demographics().unwrap().unwrap();
        assert_eq!(aged.age_years, Some(27));
    }

    #[test]
    fn an_age_is_a_number_of_years() {
        for typed in ["1987", "-3", "27.5", "twenty", "4"] {
            let about = About { age: typed.into(), ..About::default() };
            assert_eq!(about.demographics(), Err(typed.to_owned()));
        }
    }
}
