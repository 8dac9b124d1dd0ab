//! The first screen: what is won, what is lost, when it does not pay. Every word follows from the rows.

use std::fmt::Write;

use crate::bench::reference::Pair;
use crate::bench::report::figure::short;
use crate::bench::row::Row;
use crate::bench::trade::{Place, Trade, Verdict};

/// The sentences and the table of ratios.
pub fn summary(rows: &[Row], pairs: &[Pair<'_>], trades: &[Trade]) -> String {
    let verdict = |wanted: Verdict| trades.iter().filter(move |trade| trade.verdict() == wanted);
    let mut html = String::from("<div class=verdicts>");
    let texels = span(pairs.iter().map(Pair::fewer_texels), 0, 1);
    let times = span(pairs.iter().filter_map(Pair::time_ratio), 2, 2);
    let errors = span(pairs.iter().filter_map(Pair::error_ratio), 2, 2);
    let capped = match pairs.iter().filter(|pair| pair.adaptive.is_capped()).count() {
        0 => String::new(),
        count => {
            format!(" In {count} of {} cases the map is at its cap: narrow soft shadows are widened.", pairs.len())
        }
    };
    let size = pairs.first().map_or_else(String::new, |pair| pair.fixed.key.size.clone());
    let _ = write!(
        html,
        "<div><h3>What you win</h3><p><b>{texels}</b> times fewer texels than a fixed map of {size}, and a shadow that \
         takes <b>{times}</b> of its time.</p></div>\
         <div><h3>What you lose</h3><p>The error in the penumbra is <b>{errors}</b> of the fixed map's: the texels are as \
         large as the filter hides, no smaller.{capped}</p></div>"
    );
    let failing: Vec<String> = verdict(Verdict::DoesNotPay).map(name).collect();
    let paying = verdict(Verdict::Pays).count();
    let _ = write!(html, "<div><h3>When it does not pay</h3><p>");
    html += &match (trades.len(), failing.len()) {
        (0, _) => "Unknown: two fixed sizes at least are needed to draw their curve.".to_owned(),
        (count, 0) => format!("In none of {count} cases does a fixed size give the same error in less time."),
        (count, found) => format!(
            "In <b>{found}</b> of {count} cases a fixed size gives the same error in less time: {}. In {paying} the adaptive \
             one wins.",
            failing.join(", ")
        ),
    };
    // Where no fixed size compares, its absence says nothing.
    html += &match verdict(Verdict::Elsewhere).count() {
        0 => String::new(),
        count => format!(
            " In <b>{count}</b> the run cannot tell: the adaptive map is faster and coarser than every fixed one, or slower \
             and finer. More <code>--sizes</code> would."
        ),
    };
    html += "</p></div></div>";
    html + &table(rows, pairs, trades)
}

fn table(rows: &[Row], pairs: &[Pair<'_>], trades: &[Trade]) -> String {
    let mut html = String::from(
        "<div class=wide><table class=ratios><thead><tr><th>Scene<th>Filter<th>Fixed<th>Adaptive<th>Texels,<br>times fewer\
         <th>Time<th>of it,<br>size<th>Error<th>Error,<br>light<th>Frame<br>rate<th>Error in<br>equal time<th>Time for<br>equal error<th>Verdict</thead><tbody>",
    );
    for pair in pairs {
        let trade = trades.iter().find(|trade| trade.key == pair.adaptive.key);
        let _ = write!(
            html,
            "<tr><td>{}<td>{}<td>{}<td>{}{}<td>{:.1}<td>{}<td>{}<td>{}<td>{}<td>{}{}",
            pair.adaptive.key.scene,
            pair.adaptive.key.filter_and_share(),
            pair.fixed.sizes_words(),
            pair.adaptive.sizes_words(),
            if pair.adaptive.is_capped() { " (cap)" } else { "" },
            pair.fewer_texels(),
            times(pair.time_ratio()),
            times(pair.time_ratio_of_size(rows)),
            times(pair.error_ratio()),
            times(pair.light_error_ratio()),
            times(pair.frame_rate_ratio()),
            trade.map_or_else(|| "<td>-<td>-<td>-".to_owned(), cells),
        );
    }
    let share = pairs.iter().find_map(|pair| pair.adaptive.key.share()).map_or_else(String::new, |share| {
        format!(" <b>@{share}</b> lets the narrowest {} % of the penumbra's pixels show texels.", short(100.0 * share))
    });
    html + "</tbody></table></div>\
            <p class=note><b>Time</b>, <b>Error</b> (RMS over the penumbra against the same filter without texels, and against \
            the light itself) and <b>Frame rate</b> (with receivers and shading; above 1 is faster) are adaptive over fixed. An \
            adaptive map also skips filters where its demand pass found light or dark: <b>of it, size</b> is the time over that \
            of a fixed map that skips them too. <b>Error in equal time</b> and <b>Time for equal error</b> are adaptive over the \
            curve of all fixed sizes, where it reaches: below 1 no fixed size does as well."
        + &share
        + "</p>"
}

fn cells(trade: &Trade) -> String {
    let place = |place: Place, below: &str, above: &str| match place {
        Place::Ratio(ratio) => format!("<td>{ratio:.2}"),
        Place::BelowAll => format!("<td class=side>{below}"),
        Place::AboveAll => format!("<td class=side>{above}"),
    };
    let verdict = match trade.verdict() {
        Verdict::Pays => "<td class=pays>pays",
        Verdict::Even => "<td class=even>even",
        Verdict::DoesNotPay => "<td class=loses>does not pay",
        Verdict::Elsewhere => "<td class=even>incomparable",
    };
    place(trade.error_at_equal_time, "faster than all", "slower than all")
        + &place(trade.time_at_equal_error, "finer than all", "coarser than all")
        + verdict
}

fn name(trade: &Trade) -> String {
    format!("{} {}", trade.key.scene, trade.key.filter_and_share())
}

fn times(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "-".into(), |ratio| format!("{ratio:.2}"))
}

/// `4 to 380`, `7` where both ends print alike; the digits of small and of large numbers.
fn span(values: impl Iterator<Item = f64>, digits: usize, digits_below_10: usize) -> String {
    let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(a, b), value| (a.min(value), b.max(value)));
    if least > most {
        return "an unknown number of".into();
    }
    let word =
        |value: f64| if value < 10.0 { format!("{value:.digits_below_10$}") } else { format!("{value:.digits$}") };
    let (least, most) = (word(least), word(most));
    if least == most { least } else { format!("{least} to {most}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples::row;
    use crate::bench::reference::pairs;
    use crate::bench::trade::trades;

    #[test]
    fn a_span_says_one_number_once() {
        assert_eq!(span([2.0, 40.4].into_iter(), 0, 1), "2.0 to 40");
        assert_eq!(span([0.5, 0.501].into_iter(), 2, 2), "0.50");
    }

    #[test]
    fn the_cases_in_which_it_does_not_pay_are_named() {
        let mut rows = Vec::new();
        for scene in ["yard", "contact"] {
            rows.extend([row(scene, "pcf", "1024", 10.0, 0.1), row(scene, "pcf", "2048", 40.0, 0.05)]);
        }
        rows.extend([row("yard", "pcf", "adaptive", 30.0, 0.09), row("contact", "pcf", "adaptive", 12.0, 0.06)]);
        let html = summary(&rows, &pairs(&rows), &trades(&rows));
        assert!(html.contains("In <b>1</b> of 2 cases") && html.contains("less time: yard pcf."), "{html}");
        assert!(html.contains("pays") && html.contains("takes <b>0.30 to 0.75</b> of its time"), "{html}");
        assert!(!html.contains("cannot tell"), "{html}");
    }

    #[test]
    fn where_no_fixed_size_compares_the_page_says_that_it_cannot_tell() {
        let fixed = [row("yard", "pcf", "1024", 10.0, 0.1), row("yard", "pcf", "2048", 40.0, 0.05)];
        let rows = [fixed.as_slice(), &[row("yard", "pcf", "adaptive@0.05", 5.0, 0.2)]].concat();
        let html = summary(&rows, &pairs(&rows), &trades(&rows));
        assert!(html.contains("In none of 1 cases") && html.contains("In <b>1</b> the run cannot tell"), "{html}");
        assert!(html.contains("<b>@0.05</b> lets the narrowest 5 % of the penumbra"), "{html}");
    }
}
