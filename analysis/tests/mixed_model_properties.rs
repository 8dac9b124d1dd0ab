//! The mixed model over random small sets of people: numbers or a refusal, whatever they answered.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use proptest::prelude::*;
use scumble_analysis::{Assumptions, Interval, MixedModel, PersonAnswers, Quantity};

/// People with 0 to 12 answers each, at intensities of whole tenths, which repeat, from 1e-2 to 100 texels and beyond.
fn any_people() -> impl Strategy<Value = Vec<PersonAnswers>> {
    let intensity = prop_oneof![6 => -10_i32..=5, 1 => -60_i32..=60].prop_map(|tenths| 0.1 * f64::from(tenths));
    let answers = prop::collection::vec((intensity, any::<bool>()), 0..=12);
    let guess = prop_oneof![Just(0.5), 0.01..0.9];
    prop::collection::vec((guess, answers).prop_map(|(guess, answers)| PersonAnswers::new(guess, answers)), 0..=5)
}

fn any_assumptions() -> impl Strategy<Value = Assumptions> {
    (0.0..0.2, 0.5..10.0_f64).prop_map(|(blind_share, slope)| Assumptions { guess: 0.5, blind_share, slope })
}

const QUANTITIES: [Quantity; 4] = [
    Quantity::MEDIAN,
    Quantity::Log10Ratio { z: 1.645, detection: 0.1 },
    Quantity::Log10BetweenSd,
    Quantity::Log10Slope,
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_people_give_finite_numbers_and_intervals_that_hold_their_value_or_one_line(
        people in any_people(),
        known in any_assumptions(),
    ) {
        let fit = match MixedModel::new(people, known).fit() {
            Ok(fit) => fit,
            Err(refusal) => {
                prop_assert!(!refusal.to_string().contains('\n'), "{refusal}");
                return Ok(());
            }
        };
        let found = fit.parameters();
        for value in [found.log10_ratio, found.between_sd, found.slope, found.blind_share] {
            prop_assert!(value.is_finite(), "{found:?}");
        }
        for quantity in QUANTITIES {
            match Interval::of(&fit, quantity) {
                Err(refusal) => prop_assert!(!refusal.to_string().contains('\n'), "{refusal}"),
                Ok(Interval { value, ci95: [low, high], standard_error }) => {
                    prop_assert!(low <= value && value <= high, "{low} {value} {high}");
                    prop_assert!(low.is_finite() && high.is_finite() && standard_error.is_finite() && standard_error >= 0.0);
                }
            }
        }
    }
}
