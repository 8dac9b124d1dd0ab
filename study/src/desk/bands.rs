//! How each staircase's interval narrowed, trial by trial.
//!
//! A track holds its responses and its posterior of now. The posteriors on the way are computed from the prior and
//! the responses, each once: a session that goes on costs one update a trial.

use scumble_psychophysics::{Error, Estimate, Protocol, Staircase, Track};

/// The intervals of every staircase of a session.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bands(Vec<Band>);

#[derive(Clone, Debug)]
struct Band {
    staircase: Staircase,
    responses: Vec<(f64, bool)>,
    /// From the prior on, one more than responses.
    ratio_intervals90: Vec<(f64, f64)>,
}

impl Bands {
    /// The 5 % and 95 % quantiles of the ratio of track `index`, of its prior and after each of its responses.
    ///
    /// Errors: responses that the staircase refuses, which no track holds.
    pub(crate) fn of(&mut self, protocol: &Protocol, index: usize, track: &Track) -> Result<&[(f64, f64)], Error> {
        while self.0.len() <= index {
            self.0.push(Band::at_prior(protocol, track)?);
        }
        let band = &mut self.0[index];
        // A repeated round begins anew.
        if !track.responses().starts_with(&band.responses) || band.responses.is_empty() {
            *band = Band::at_prior(protocol, track)?;
        }
        for (intensity, is_right) in &track.responses()[band.responses.len()..] {
            band.staircase.update(*intensity, *is_right)?;
            band.responses.push((*intensity, *is_right));
            band.ratio_intervals90.push(Estimate::of(&band.staircase).ratio_interval90);
        }
        Ok(&band.ratio_intervals90)
    }
}

impl Band {
    fn at_prior(protocol: &Protocol, track: &Track) -> Result<Self, Error> {
        let staircase = protocol.staircase_at(track.prior_ratio())?;
        let ratio_intervals90 = vec![Estimate::of(&staircase).ratio_interval90];
        Ok(Self { staircase, responses: Vec::new(), ratio_intervals90 })
    }
}
