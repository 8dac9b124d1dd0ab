//! How the numbers came about: in words, in a list, and the files they come from.

use scumble_psychophysics::{StaircaseMethod, Task};

use super::{escaped, threshold_in_words};
use crate::{
    analysis::{Analysis, SOFTWARE},
    assumptions::Assumptions,
    mixed_model::MixedParameters,
    people::Study,
};

/// A paragraph that a paper's methods and results may take over.
pub(super) fn in_words(study: &Study, analysis: &Analysis) -> String {
    let protocol = &study.protocol;
    let worst = analysis.worst();
    let [low, high] = worst.ratio_ci95();
    let MixedParameters { between_sd, slope, blind_share, .. } = worst.fit.parameters();
    let task = match protocol.task {
        Task::TwoAlternative => "chose which of two pictures showed the filtered line (two-alternative forced choice)",
        Task::YesNo => "told for single pictures whether they showed a filtered line (yes-no)",
    };
    let method = match protocol.staircase.method {
        StaircaseMethod::Quest => "QUEST",
        StaircaseMethod::QuestPlus => "QUEST+",
    };
    let who = if study.is_simulated() { "simulated people" } else { "people" };
    let texels: Vec<String> = protocol.conditions.texels_px.iter().map(ToString::to_string).collect();
    let viewers = analysis.population.point(0.95, 0.10).map_or(String::new(), |point| {
        let [low, high] = point.ci95;
        format!(
            " To be seen on at most 10 % of the trials by 95 % of viewers, the radius has to be {:.1} texels ({low:.1} to {high:.1}).",
            point.ratio
        )
    });
    let form = worst.exponent.map_or(String::new(), |mean| {
        let [low, high] = mean.ci95;
        format!(" Radius grew with the texel to the power {:.2} ({low:.2} to {high:.2}).", mean.mean)
    });
    format!(
        "<h2>In words</h2>\n<blockquote><p>{} {who} {task} in {} measured trials of the protocol \u{201c}{}\u{201d} (texels of {} px, \
         staircases with {} placement). All answers of a condition were fitted by a mixed-effects Weibull model (complementary log-log link) with \
         log-normal thresholds over people and a shared slope and share of blind trials (answered without looking: lapses), by maximum likelihood with weak \
         priors on slope and blind trials; intervals are 95 % profile-likelihood intervals with a cut-off from Student's \
         t with {} degrees of freedom. The threshold is the ratio of filter radius to texel size at which {}. In the worst \
         condition ({}) the median person's threshold was {:.2} texels (95 % CI {low:.2} to {high:.2}), with a standard deviation \
         between people of {between_sd:.3} log10 units, a slope of {slope:.1} per log10 unit and {:.1} % blind trials.{form}{viewers}</p></blockquote>\n",
        worst.fit.people(),
        study.trial_count(),
        escaped(&protocol.name),
        texels.join(", "),
        method,
        worst.fit.people() - 1,
        threshold_in_words(),
        worst.name,
        worst.ratio(),
        100.0 * blind_share,
    )
}

pub(super) fn left_out(study: &Study, exclusions: &[String]) -> String {
    let sentences: Vec<&String> = study.notices.iter().chain(exclusions).collect();
    if sentences.is_empty() {
        return "<h2>Left out</h2>\n<p>Nothing: every condition of every person has a \
                threshold.</p>\n"
            .to_owned();
    }
    let items: String = sentences.iter().map(|sentence| format!("<li>{}</li>\n", escaped(sentence))).collect();
    format!(
        "<h2>Left out</h2>\n<ul>\n{items}</ul>\n<p class=\"note\">A condition without a threshold \
         of its own still adds its answers to the person's ratio.</p>\n"
    )
}

pub(super) fn method(study: &Study, analysis: &Analysis) -> String {
    let protocol = &study.protocol;
    let known = Assumptions::of_protocol(protocol);
    let counted = study.people.iter().filter(|person| person.checks.lines > 0).count();
    let guess = match counted {
        0 => format!("guess {}", known.guess),
        _ => format!(
            "guess rate of each person from the lines called artifacts, (false alarms + 1/2) / (lines + 1) \
             ({counted} of {} people; {} for the others)",
            study.people.len(),
            known.guess
        ),
    };
    let single_pictures = match protocol.task {
        Task::TwoAlternative => "",
        Task::YesNo => {
            "\n<li>Guesses are taken out as if an artifact were either seen or not (high threshold). Of people with \
             noisy traces and a strict criterion (signal detection, 10 % false alarms) the ratio then comes out 8 % \
             low, and 16 % low where a guess rate of one half is assumed; with two alternatives neither is.</li>"
        }
    };
    let (converged, staircases) = analysis
        .thresholds
        .iter()
        .fold((0, 0), |(converged, staircases), entry| (converged + entry.converged, staircases + entry.staircases));
    format!(
        "<h2>Method</h2>\n<ul>\n<li>Protocol <i>{}</i>: {guess}, lapses {}, slope {} per decade. \
         Threshold: {}. {converged} of {staircases} staircases converged by the experiment's rule; the \
         others enter too, because leaving them out would select answers.</li>\n<li>Per person and \
         condition: maximum-likelihood Weibull function, its location alone free. A threshold that the \
         answers do not bound on both sides (95 % likelihood ratio) is refused.</li>\n<li>Per \
         pattern, contrast and kernel: one mixed model of all answers at all texel sizes, thresholds log-normal over \
         people, Weibull function with a shared slope and share of blind trials; intervals are profile likelihoods, cut where \
         Student's t with people - 1 degrees of freedom is.</li>\n<li>Lines alone, catch trials and practice are \
         in no threshold.</li>{single_pictures}\n<li>Intervals do not cover a wrong slope, learning, or viewers unlike \
         these.</li>\n</ul>\n",
        escaped(&protocol.name),
        known.blind_share,
        known.slope,
        threshold_in_words(),
    )
}

pub(super) fn sources(study: &Study) -> String {
    let rows: String = study
        .session_hashes()
        .iter()
        .map(|hash| format!("<tr><td>{}</td><td><code>{}</code></td></tr>\n", escaped(&hash.session), hash.sha256))
        .collect();
    format!(
        "<h2>Sessions</h2>\n<details><summary>{} sessions with their SHA-256</summary>\n<div \
         class=\"wide\"><table>\n{rows}</table></div></details>\n<p><small>Written by \
         {SOFTWARE}.</small></p>\n",
        study.sessions.len()
    )
}
