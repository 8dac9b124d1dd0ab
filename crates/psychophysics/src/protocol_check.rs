//! The ranges of a protocol's parameters. Each error names the key as it stands in the file.

use crate::error::{Error, require};
use crate::protocol::{Protocol, Task};

/// What a ratio may be.
const POSITIVE_RATIO: &str = "a finite number of texels above 0";

impl Protocol {
    /// Refuses parameters outside their ranges and parameters that contradict each other; the error
    /// names the key.
    pub fn check(&self) -> Result<(), Error> {
        require(!self.name.trim().is_empty(), "name", format!("{:?}", self.name), "a word")?;
        self.check_conditions()?;
        self.check_pictures()?;
        self.check_texels()?;
        self.check_schedule()?;
        self.check_extra_trials()?;
        self.convergence.check()?;
        for ratio in &self.staircase.prior_ratios {
            self.staircase_at(*ratio).map_err(Error::in_table("staircase"))?;
        }
        Ok(())
    }

    fn check_conditions(&self) -> Result<(), Error> {
        let conditions = &self.conditions;
        check_list("conditions.patterns", &conditions.patterns)?;
        check_list("conditions.contrasts", &conditions.contrasts)?;
        check_list("conditions.kernels", &conditions.kernels)?;
        check_list("conditions.texels_px", &conditions.texels_px)?;
        check_list("staircase.prior_ratios", &self.staircase.prior_ratios)?;
        for contrast in &conditions.contrasts {
            require(is_contrast(*contrast), "conditions.contrasts", contrast, "above 0 to 1")?;
        }
        require(is_contrast(self.practice.contrast), "practice.contrast", self.practice.contrast, "above 0 to 1")?;
        for ratio in &self.staircase.prior_ratios {
            require(is_positive(*ratio), "staircase.prior_ratios", ratio, POSITIVE_RATIO)?;
        }
        for ratio in &self.practice.ratios {
            require(is_positive(*ratio), "practice.ratios", ratio, POSITIVE_RATIO)?;
        }
        Ok(())
    }

    fn check_pictures(&self) -> Result<(), Error> {
        let pictures = &self.pictures;
        for (key, side_px) in [("pictures.width_px", pictures.width_px), ("pictures.height_px", pictures.height_px)] {
            require((1..=scumble_stimuli::MAX_SIDE_PX).contains(&side_px), key, side_px, "1 to 16384 pixels")?;
        }
        require(is_positive(pictures.ratio_min), "pictures.ratio_min", pictures.ratio_min, POSITIVE_RATIO)?;
        // A turn of more than a few degrees makes another pattern of the step.
        let range_rad = pictures.tilt_range_rad;
        require((0.0..=0.1).contains(&range_rad), "pictures.tilt_range_rad", range_rad, "0 to 0.1 radians")
    }

    fn check_texels(&self) -> Result<(), Error> {
        let measured = self.conditions.texels_px.iter().map(|texel_px| ("conditions.texels_px", *texel_px));
        let caught = self.catch_trials.iter().map(|catch| ("catch_trials.texel_px", catch.texel_px));
        for (key, texel_px) in measured.chain([("practice.texel_px", self.practice.texel_px)]).chain(caught) {
            let (smallest_px, largest_px) = self.radius_range_px(texel_px);
            require(
                is_positive(texel_px) && smallest_px < largest_px,
                key,
                texel_px,
                "above 0 and small enough that a radius fits between ratio_min texels and half the picture less a texel",
            )?;
        }
        Ok(())
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

    fn check_extra_trials(&self) -> Result<(), Error> {
        if let Some(catch) = &self.catch_trials {
            let is_share = catch.share > 0.0 && catch.share <= 0.5;
            require(is_share, "catch_trials.share", catch.share, "above 0 to 0.5, or no such table")?;
            require(is_positive(catch.ratio), "catch_trials.ratio", catch.ratio, POSITIVE_RATIO)?;
        }
        let Some(lines) = &self.line_trials else { return Ok(()) };
        let is_share = lines.share > 0.0 && lines.share <= 0.9;
        require(is_share, "line_trials.share", lines.share, "above 0 to 0.9, or no such table")?;
        let allowed = "no such table with the task two_alternative, which shows a line in every trial";
        require(self.task == Task::YesNo, "line_trials", "given", allowed)
    }
}

/// A list without a value or with one value twice measures nothing, or one thing twice.
fn check_list<T: PartialEq + std::fmt::Debug>(key: &str, values: &[T]) -> Result<(), Error> {
    require(!values.is_empty(), key, "empty", "at least one value")?;
    let twice = values.iter().enumerate().find(|(index, value)| values[..*index].contains(value));
    match twice {
        Some((_, value)) => Err(Error::parameter(key, format!("{value:?} twice"), "each value once")),
        None => Ok(()),
    }
}

fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

fn is_contrast(value: f64) -> bool {
    value > 0.0 && value <= 1.0
}
