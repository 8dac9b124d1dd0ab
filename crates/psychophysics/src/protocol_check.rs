//! The ranges of a protocol's parameters, and parameters that contradict each other. Each error names the
//! key as it stands in the file, `table.list[1]` for the second value of a list.

use std::ops::RangeInclusive;

use crate::error::{Error, require};
use crate::protocol::{Protocol, Task};

/// Ratios, three decades to either side of a texel: beyond them a picture shows nothing but steps or
/// nothing but blur, and a typing error is likelier than a wish.
const RATIOS: RangeInclusive<f64> = 0.001..=1000.0;
const RATIO_ALLOWED: &str = "0.001 to 1000 texels";

/// Most staircases of a session: at ten trials each, days.
const STAIRCASES_MAX: usize = 1000;

/// Most points of all tables of thresholds together: 80 MB of numbers for each copy.
const TABLE_POINTS_MAX: f64 = 1e7;

/// Widest table: ten decades to either side of the prior are further than any picture reaches.
const TABLE_WIDTH_MAX_LOG10: f64 = 20.0;

/// Largest turn: the line of a step, which leaves the middle by this at the side of a picture as wide as
/// high, stays on the picture with room for a penumbra.
const TILT_RANGE_MAX_RAD: f64 = 0.2;

impl Protocol {
    /// Refuses parameters outside their ranges and parameters that contradict each other; the error
    /// names the key.
    pub fn check(&self) -> Result<(), Error> {
        require(!self.name.trim().is_empty(), "name", format!("{:?}", self.name), "a word")?;
        self.check_conditions()?;
        self.check_pictures()?;
        self.check_texels()?;
        self.check_practice()?;
        self.check_schedule()?;
        self.check_catch_trials()?;
        self.check_line_trials()?;
        self.exclusions.unwrap_or_default().check()?;
        self.convergence.check()?;
        self.check_staircase()
    }

    fn check_conditions(&self) -> Result<(), Error> {
        let conditions = &self.conditions;
        check_list("conditions.patterns", &conditions.patterns)?;
        check_list("conditions.contrasts", &conditions.contrasts)?;
        check_list("conditions.kernels", &conditions.kernels)?;
        check_list("conditions.texels_px", &conditions.texels_px)?;
        check_list("staircase.prior_ratios", &self.staircase.prior_ratios)?;
        check_each("conditions.contrasts", &conditions.contrasts, is_contrast, "above 0 to 1")?;
        check_each("staircase.prior_ratios", &self.staircase.prior_ratios, is_ratio, RATIO_ALLOWED)?;
        let lists = [conditions.contrasts.len(), conditions.kernels.len(), conditions.texels_px.len()];
        let priors = self.staircase.prior_ratios.len();
        let staircases = lists.iter().fold(priors * conditions.patterns.len(), |n, list| n.saturating_mul(*list));
        let allowed = "lists that make at most 1000 staircases when crossed";
        require(staircases <= STAIRCASES_MAX, "conditions", format!("{staircases} staircases"), allowed)
    }

    fn check_pictures(&self) -> Result<(), Error> {
        let pictures = &self.pictures;
        for (key, side_px) in [("pictures.width_px", pictures.width_px), ("pictures.height_px", pictures.height_px)] {
            require((1..=scumble_stimuli::MAX_SIDE_PX).contains(&side_px), key, side_px, "1 to 16384 pixels")?;
        }
        require(is_ratio(pictures.ratio_min), "pictures.ratio_min", pictures.ratio_min, RATIO_ALLOWED)?;
        let range_rad = pictures.tilt_range_rad;
        let is_range = (0.0..=TILT_RANGE_MAX_RAD).contains(&range_rad);
        require(is_range, "pictures.tilt_range_rad", range_rad, "0 to 0.2 radians")
    }

    fn check_texels(&self) -> Result<(), Error> {
        let fits = |texel_px: f64| {
            let (smallest_px, largest_px) = self.radius_range_px(texel_px);
            texel_px >= scumble_stimuli::MIN_TEXEL_PX && smallest_px < largest_px
        };
        let allowed = "1 pixel or more and small enough that a radius fits between ratio_min texels and half the picture less a texel";
        check_each("conditions.texels_px", &self.conditions.texels_px, fits, allowed)?;
        require(fits(self.practice.texel_px), "practice.texel_px", self.practice.texel_px, allowed)?;
        let Some(catch) = &self.catch_trials else { return Ok(()) };
        require(fits(catch.texel_px), "catch_trials.texel_px", catch.texel_px, allowed)
    }

    fn check_practice(&self) -> Result<(), Error> {
        let practice = &self.practice;
        require(is_contrast(practice.contrast), "practice.contrast", practice.contrast, "above 0 to 1")?;
        let fits = |ratio: f64| self.shows(ratio, practice.texel_px);
        check_each("practice.ratios", &practice.ratios, fits, RATIO_SHOWN)
    }

    fn check_schedule(&self) -> Result<(), Error> {
        let schedule = &self.schedule;
        require(schedule.trials_min >= 1, "schedule.trials_min", schedule.trials_min, "1 or more")?;
        // A staircase of ten thousand trials is a typing error: half a day for one number.
        let allowed = "trials_min to 10000";
        let is_max = (schedule.trials_min..=10_000).contains(&schedule.trials_max);
        require(is_max, "schedule.trials_max", schedule.trials_max, allowed)?;
        let rest = schedule.rest_every_trials.unwrap_or(1);
        require(rest >= 1, "schedule.rest_every_trials", rest, "1 or more, or no such key")
    }

    fn check_catch_trials(&self) -> Result<(), Error> {
        let Some(catch) = &self.catch_trials else { return Ok(()) };
        let is_share = catch.share > 0.0 && catch.share <= 0.5;
        require(is_share, "catch_trials.share", catch.share, "above 0 to 0.5, or no such table")?;
        require(self.shows(catch.ratio, catch.texel_px), "catch_trials.ratio", catch.ratio, RATIO_SHOWN)
    }

    fn check_line_trials(&self) -> Result<(), Error> {
        let Some(lines) = &self.line_trials else { return Ok(()) };
        let allowed = "no such table with the task two_alternative, which shows a line in every trial";
        require(self.task == Task::YesNo, "line_trials", "given", allowed)?;
        let is_share = lines.share > 0.0 && lines.share <= 0.9;
        require(is_share, "line_trials.share", lines.share, "above 0 to 0.9, or no such table")
    }

    fn check_staircase(&self) -> Result<(), Error> {
        let rules = &self.staircase;
        rules.check().map_err(Error::in_table("staircase"))?;
        let width = rules.table_width_log10;
        require(width <= TABLE_WIDTH_MAX_LOG10, "staircase.table_width_log10", width, "above 0 to 20")?;
        let staircases = self.all_conditions().len() * rules.prior_ratios.len();
        let curves = rules.slopes_per_log10.len().max(1) * rules.lapse_probabilities.len().max(1);
        let tables = (staircases * curves) as f64;
        let allowed = "a step that makes at most 10 million points in all tables of the session together";
        let fits = tables * width / rules.table_step_log10 <= TABLE_POINTS_MAX;
        require(fits, "staircase.table_step_log10", rules.table_step_log10, allowed)
    }

    /// Whether a picture shows `ratio` texels as they are, without clamping.
    fn shows(&self, ratio: f64, texel_px: f64) -> bool {
        let (smallest_px, largest_px) = self.radius_range_px(texel_px);
        (smallest_px..=largest_px).contains(&(ratio * texel_px))
    }
}

/// What a ratio that is not chosen by a staircase may be.
const RATIO_SHOWN: &str = "what the picture can show: ratio_min to half its shorter side less a texel, in texels";

/// A list without a value or with one value twice measures nothing, or one thing twice.
fn check_list<T: PartialEq + std::fmt::Debug>(key: &str, values: &[T]) -> Result<(), Error> {
    require(!values.is_empty(), key, "empty", "at least one value")?;
    let is_new = |(index, value): (usize, &T)| {
        let allowed = "each value once";
        require(!values[..index].contains(value), &format!("{key}[{index}]"), format!("{value:?} again"), allowed)
    };
    values.iter().enumerate().try_for_each(is_new)
}

/// Refuses the first value that is not `good`.
fn check_each(key: &str, values: &[f64], good: impl Fn(f64) -> bool, allowed: &'static str) -> Result<(), Error> {
    let mut numbered = values.iter().enumerate();
    numbered.try_for_each(|(index, value)| require(good(*value), &format!("{key}[{index}]"), value, allowed))
}

fn is_ratio(value: f64) -> bool {
    RATIOS.contains(&value)
}

fn is_contrast(value: f64) -> bool {
    value > 0.0 && value <= 1.0
}
