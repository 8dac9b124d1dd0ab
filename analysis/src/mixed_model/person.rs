//! A person's likelihood with the threshold integrated out, and its gradient.
//!
//! `L = sum_k h phi(z_k) prod_j p_j(m + s z_k)`: the trapezoid rule on a grid of `z` that does not depend on the
//! parameters. It converges faster than any power of its step for integrands that fall like the normal density
//! (Trefethen & Weideman 2014), and needs no maximum to be found first: with a steep psychometric function a
//! person's likelihood is a stair with several. The gradient is that of the sum itself, exact to rounding.

use std::f64::consts::{LN_10, TAU};

use super::{Coordinates, MixedParameters, PersonAnswers};
use crate::assumptions::DETECTION_AT_THRESHOLD;

/// Half of the grid's width: beyond 6 standard deviations lie 2e-9 of all people.
const REACH: f64 = 6.0;

/// Largest distance of the nodes.
const STEP_MOST: f64 = 0.2;

/// Distance of the nodes times the square root of the number of answers. A person's likelihood has a standard deviation of
/// 0.4 log10 units over that root, 4 / root in `z` at `s = 0.1`: three nodes in a standard deviation, one at `s = 0.3`.
const STEP_BY_ROOT_OF_ANSWERS: f64 = 1.25;

/// `ln L` and its derivatives in `m`, `s`, `ln b` and `e`.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Marginal {
    /// `ln L`.
    pub ln_likelihood: f64,
    /// Derivatives.
    pub gradient: Coordinates,
    /// Mean of the person's `z` after the answers.
    pub z: f64,
}

impl Marginal {
    /// The sum over two independent people; their `z` means nothing then.
    pub fn plus(&self, other: &Self) -> Self {
        let gradient = std::array::from_fn(|index| self.gradient[index] + other.gradient[index]);
        Self { ln_likelihood: self.ln_likelihood + other.ln_likelihood, gradient, z: self.z + other.z }
    }
}

/// What the answers so far say at one node.
#[derive(Debug, Clone, Copy)]
struct Node {
    z: f64,
    /// `ln phi(z)` and the logarithms of all but the factors in `product`.
    ln_weight: f64,
    /// Factors of the likelihood that are not in `ln_weight` yet.
    product: f64,
    /// Derivatives of `ln p` in `ln u`, summed; times the decades to the threshold, summed; in `e`, summed.
    rise: f64,
    rise_decades: f64,
    rise_blind: f64,
}

/// From this `u` on, `exp(-u)` is below 1e-217 and taken for 0.
const UNSEEN_LEAST: f64 = 500.0;

/// Below this a product of probabilities is put away as a logarithm, which saves most logarithms.
const PRODUCT_LEAST: f64 = 1e-100;

/// The least factor of a product.
const FACTOR_LEAST: f64 = 1e-100;

impl Node {
    /// Takes in `count` answers of a probability; gives `count / probability`.
    fn answered(&mut self, count: f64, probability: f64) -> f64 {
        if count == 0.0 {
            return 0.0;
        }
        if count == 1.0 && probability > FACTOR_LEAST {
            self.product *= probability;
            if self.product < PRODUCT_LEAST {
                self.ln_weight += self.product.ln();
                self.product = 1.0;
            }
        } else {
            self.ln_weight += count * probability.ln();
        }
        count / probability
    }
}

/// Integrates over the person's `z`.
pub(crate) fn marginal(person: &PersonAnswers, shared: &MixedParameters) -> Marginal {
    let MixedParameters { log10_ratio, between_sd, slope, blind_share } = *shared;
    let step = step(person);
    let mut nodes = nodes(step);
    let (miss, seeing) = (1.0 - person.guess, 1.0 - blind_share);
    let per_decade = LN_10 * slope;
    let unseen_at_threshold = 1.0 - DETECTION_AT_THRESHOLD / seeing;
    let w0 = -unseen_at_threshold.ln();
    // d ln w0 / d e.
    let w0_rise = DETECTION_AT_THRESHOLD / (seeing * seeing * unseen_at_threshold * w0);
    // From node to node u grows by one factor.
    let growth = (per_decade * between_sd * step).exp();
    for count in &person.counts {
        let misses = count.total - count.correct;
        let mut decades = count.x + log10_ratio + between_sd * nodes[0].z;
        let mut u = w0 * (per_decade * decades).exp();
        for node in &mut nodes {
            let missed = if u < UNSEEN_LEAST { (-u).exp() } else { 0.0 };
            let correct = person.guess + miss * seeing * (1.0 - missed);
            let wrong = miss * (blind_share + seeing * missed);
            let pull = node.answered(count.correct, correct) - node.answered(misses, wrong);
            let rise = pull * miss * seeing * missed * u.min(UNSEEN_LEAST);
            node.rise += rise;
            node.rise_decades += rise * decades;
            node.rise_blind += rise * w0_rise - pull * miss * (1.0 - missed);
            decades += between_sd * step;
            u *= growth;
        }
    }
    let ln_weight = |node: &Node| node.ln_weight + node.product.ln();
    let largest = nodes.iter().map(ln_weight).fold(f64::NEG_INFINITY, f64::max);
    let (mut total, mut gradient, mut z) = (0.0, [0.0; 4], 0.0);
    for node in &nodes {
        let weight = (ln_weight(node) - largest).exp();
        total += weight;
        z += weight * node.z;
        let own =
            [per_decade * node.rise, per_decade * node.rise * node.z, per_decade * node.rise_decades, node.rise_blind];
        for (sum, part) in gradient.iter_mut().zip(own) {
            *sum += weight * part;
        }
    }
    Marginal { ln_likelihood: largest + (total * step).ln(), gradient: gradient.map(|sum| sum / total), z: z / total }
}

/// Distance of the nodes: the more answers, the narrower a person's likelihood.
fn step(person: &PersonAnswers) -> f64 {
    let answers: f64 = person.counts.iter().map(|count| count.total).sum();
    STEP_MOST.min(STEP_BY_ROOT_OF_ANSWERS / answers.sqrt())
}

fn nodes(step: f64) -> Vec<Node> {
    let reach = (REACH / step).ceil() as i32;
    let node = |index: i32| {
        let z = step * f64::from(index);
        Node { z, ln_weight: -0.5 * (z * z + TAU.ln()), product: 1.0, rise: 0.0, rise_decades: 0.0, rise_blind: 0.0 }
    };
    (-reach..=reach).map(node).collect()
}
