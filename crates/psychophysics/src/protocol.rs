//! The protocol: every parameter of a session, with its unit, as it stands in `session.json`.

use scumble_stimuli::Pattern;
use serde::{Deserialize, Serialize};

use crate::convergence::Convergence;
use crate::error::{Error, require};
use crate::quest::Quest;
use crate::quest_config::QuestConfig;
use crate::trial::Condition;

/// What the participant is asked and what a response of 1 means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Two pictures, a filtered line and a filtered artifact: "which one was the line?".
    /// A response of 1 means "correct"; guessing is right half of the time.
    TwoAlternative,
}

/// Trials with feedback before the measurement, none of which reaches a QUEST.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Practice {
    /// Radius in texels of each practice trial, in order.
    pub ratios: Vec<f64>,
    /// Texel size of the practice trials.
    pub texel_px: f64,
    /// Their contrast.
    pub contrast: f64,
}

/// Every parameter of a session. A round is a pattern at a contrast; its QUESTs, one a texel size,
/// are interleaved. The order of the rounds is drawn from the seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Protocol {
    /// Name on the command line.
    pub name: String,
    /// The question.
    pub task: Task,
    /// Patterns, each crossed with every contrast into a round.
    pub patterns: Vec<Pattern>,
    /// Linear light of the lit side, above 0 to 1.
    pub contrasts: Vec<f64>,
    /// Texel sizes, one QUEST each in every round.
    pub texels_px: Vec<f64>,
    /// Width of each picture in physical pixels.
    pub picture_width_px: u32,
    /// Height of each picture in physical pixels.
    pub picture_height_px: u32,
    /// Smallest radius shown, in texels.
    pub ratio_min: f64,
    /// Centre of QUEST's prior, radius in texels.
    pub prior_ratio: f64,
    /// Standard deviation of QUEST's prior in log10 of the ratio.
    pub prior_sd_log10: f64,
    /// Share of right answers at the threshold.
    pub threshold_probability: f64,
    /// Share of right answers by guessing.
    pub guess_probability: f64,
    /// Share of trials answered blindly that QUEST assumes.
    pub lapse_probability: f64,
    /// Slope of the psychometric function, per log10 unit.
    pub slope_per_log10: f64,
    /// Step of QUEST's table in log10 of the ratio.
    pub table_step_log10: f64,
    /// Width of QUEST's table in log10 of the ratio.
    pub table_width_log10: f64,
    /// Fewest trials of each QUEST.
    pub trials_min: u32,
    /// Most trials of each QUEST.
    pub trials_max: u32,
    /// When a QUEST between these ends is done.
    pub convergence: Convergence,
    /// Trials with feedback before the measurement.
    pub practice: Practice,
}

impl Protocol {
    /// The default: two alternatives, so that the guess rate of one half is true by design.
    ///
    /// From Kreuzer 2017, 4.1.3 to 4.3: patterns, contrasts, texels of 5, 10, 20 px, four rounds of
    /// three interleaved QUESTs, at least 10 trials each, threshold probability 0.82, gamma 0.5,
    /// delta 0.01, beta 3.5. Deviations: two pictures instead of the question "Is the original
    /// image a line?", and a prior of 3 texels with SD 0.6 log10, as the published one has no unit.
    /// The smallest radius, half a texel, is a fifth of the smallest published threshold.
    /// At most 28 trials a QUEST: simulated people need 240 of the 336 trials, near 25 minutes at
    /// 5 s a trial with practice and rests.
    pub fn two_alternative() -> Self {
        Self {
            name: "two-alternative".into(),
            task: Task::TwoAlternative,
            patterns: vec![Pattern::Stair, Pattern::Step],
            contrasts: vec![1.0, 0.5],
            texels_px: vec![5.0, 10.0, 20.0],
            picture_width_px: 600,
            picture_height_px: 480,
            ratio_min: 0.5,
            prior_ratio: 3.0,
            prior_sd_log10: 0.6,
            threshold_probability: 0.82,
            guess_probability: 0.5,
            lapse_probability: 0.01,
            slope_per_log10: 3.5,
            table_step_log10: 0.01,
            table_width_log10: 5.0,
            trials_min: 10,
            trials_max: 28,
            convergence: Convergence::default(),
            practice: Practice { ratios: vec![0.5, 0.5, 1.0, 1.0, 1.5, 1.5, 2.0, 2.0], texel_px: 20.0, contrast: 1.0 },
        }
    }

    /// The protocol of a name on the command line; the error lists the names.
    pub fn named(name: &str) -> Result<Self, Error> {
        match name {
            "two-alternative" => Ok(Self::two_alternative()),
            _ => Err(Error::parameter("protocol", name, "two-alternative")),
        }
    }

    /// Refuses parameters outside their ranges; the error names the parameter.
    pub fn check(&self) -> Result<(), Error> {
        self.check_lists()?;
        self.check_pictures()?;
        let trials = format!("{} to {}", self.trials_min, self.trials_max);
        require(
            self.trials_min >= 1 && self.trials_min <= self.trials_max,
            "trials_min to trials_max",
            trials,
            "at least 1, and a minimum not above the maximum",
        )?;
        require(
            self.prior_ratio.is_finite() && self.prior_ratio > 0.0,
            "prior_ratio",
            self.prior_ratio,
            "a finite number of texels above 0",
        )?;
        self.convergence.check()?;
        Quest::new(self.quest_config()).map(|_| ())
    }

    /// Parameters of each QUEST: its intensity is `log10(texel / radius)`.
    pub fn quest_config(&self) -> QuestConfig {
        QuestConfig {
            t_guess: -self.prior_ratio.log10(),
            t_guess_sd: self.prior_sd_log10,
            p_threshold: self.threshold_probability,
            beta: self.slope_per_log10,
            delta: self.lapse_probability,
            gamma: self.guess_probability,
            grain: self.table_step_log10,
            range: self.table_width_log10,
        }
    }

    /// Pattern and contrast of each round, before their order is drawn.
    pub fn rounds(&self) -> Vec<(Pattern, f64)> {
        self.patterns.iter().flat_map(|pattern| self.contrasts.iter().map(|contrast| (*pattern, *contrast))).collect()
    }

    /// What each QUEST measures, round after round, before their order is drawn.
    pub fn conditions(&self) -> Vec<Condition> {
        let of_round = |(pattern, contrast)| {
            self.texels_px.iter().map(move |texel_px| Condition { pattern, contrast, texel_px: *texel_px })
        };
        self.rounds().into_iter().flat_map(of_round).collect()
    }

    /// Smallest and largest radius shown for this texel.
    ///
    /// The smallest is `ratio_min` texels, where the steps are plain to everyone: who does not see
    /// them there guesses, and the convergence rule finds the estimate at this end.
    /// The largest keeps the penumbra of the edge, which lies within one texel of the middle,
    /// inside the picture: half of its shorter side less a texel.
    pub fn radius_range_px(&self, texel_px: f64) -> (f64, f64) {
        let shorter_px = self.picture_width_px.min(self.picture_height_px);
        let largest_px = f64::from(shorter_px) / 2.0 - texel_px;
        (self.ratio_min * texel_px, largest_px)
    }

    fn check_lists(&self) -> Result<(), Error> {
        let lists = [
            ("patterns", self.patterns.len()),
            ("contrasts", self.contrasts.len()),
            ("texels_px", self.texels_px.len()),
        ];
        for (field, length) in lists {
            require(length > 0, field, "empty", "at least one value")?;
        }
        for contrast in self.contrasts.iter().chain([&self.practice.contrast]) {
            require(*contrast > 0.0 && *contrast <= 1.0, "contrast", contrast, "above 0 to 1")?;
        }
        for ratio in &self.practice.ratios {
            require(ratio.is_finite() && *ratio > 0.0, "practice.ratios", ratio, "finite numbers of texels above 0")?;
        }
        Ok(())
    }

    fn check_pictures(&self) -> Result<(), Error> {
        for (field, side_px) in
            [("picture_width_px", self.picture_width_px), ("picture_height_px", self.picture_height_px)]
        {
            require((1..=scumble_stimuli::MAX_SIDE_PX).contains(&side_px), field, side_px, "1 to 16384 pixels")?;
        }
        require(
            self.ratio_min.is_finite() && self.ratio_min > 0.0,
            "ratio_min",
            self.ratio_min,
            "a finite number of texels above 0",
        )?;
        for texel_px in self.texels_px.iter().chain([&self.practice.texel_px]) {
            let (smallest_px, largest_px) = self.radius_range_px(*texel_px);
            require(
                *texel_px > 0.0 && smallest_px < largest_px,
                "texel_px",
                texel_px,
                "above 0 and small enough that a radius fits between ratio_min texels and half the picture less a texel",
            )?;
        }
        Ok(())
    }
}
