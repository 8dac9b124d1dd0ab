//! The first screen: what is won, what is lost, when it does not pay. Every word follows from the rows.

use std::fmt::Write;

use scumble::AtCap;

use crate::bench::cell::ratio;
use crate::bench::pair::Pair;
use crate::bench::report::figure::short;
use crate::bench::report::{distinct, escaped};
use crate::bench::row::Row;
use crate::bench::trade::{Place, Trade, Verdict};

/// The sentences and the table of ratios; `at_cap` says what pcss does at its cap.
pub fn summary(rows: &[Row], pairs: &[Pair<'_>], trades: &[Trade], at_cap: AtCap) -> String {
    if pairs.is_empty() {
        return "<p>No adaptive map stands beside a fixed one in this run: that takes a soft filter, an adaptive size and a \
                fixed one.</p>"
            .into();
    }
    let verdicts = [
        ("Texels and time", texels_and_time(pairs)),
        ("Accuracy", accuracy(pairs, at_cap)),
        ("Where it does not pay", where_it_does_not_pay(rows, trades)),
    ];
    let boxes: String =
        verdicts.iter().map(|(title, words)| format!("<div><h3>{title}</h3><p>{words}</p></div>")).collect();
    format!("<div class=verdicts>{boxes}</div>{}", table(rows, pairs, trades))
}

fn texels_and_time(pairs: &[Pair<'_>]) -> String {
    let fixed = distinct(pairs.iter().map(|pair| pair.fixed.key.size.clone())).join(" or ");
    let is_larger = pairs.iter().any(|pair| pair.fewer_texels() < 1.0);
    let below_1 = if is_larger { " (below 1: more)" } else { "" };
    let texels = span(pairs.iter().map(Pair::fewer_texels), 0, 1).unwrap_or_default();
    let time = match span(pairs.iter().filter_map(Pair::time_ratio), 2, 2) {
        Some(times) => format!("and a shadow that takes <b>{times}</b> of their time."),
        None => "of times nothing is known: the device has no timestamps.".into(),
    };
    format!("<b>{texels}</b> times fewer texels{below_1} than fixed maps of {fixed}, {time}")
}

fn accuracy(pairs: &[Pair<'_>], at_cap: AtCap) -> String {
    let Some(errors) = span(pairs.iter().filter_map(Pair::error_ratio), 2, 2) else {
        return "Nothing is known of errors: no penumbra is on screen.".into();
    };
    let capped: Vec<&Pair<'_>> = pairs.iter().filter(|pair| pair.adaptive.is_capped()).collect();
    let methods = distinct(capped.iter().map(|pair| pair.adaptive.key.method.clone()));
    // What `--cap` and `--at-cap` say of the filters.
    let is_widened = |method: &str| method == "pcss" && at_cap == AtCap::Widen;
    let shown: Vec<&str> = methods.iter().map(String::as_str).filter(|method| !is_widened(method)).collect();
    let mut effects = Vec::new();
    if methods.iter().any(|method| is_widened(method)) {
        effects.push("under pcss the narrowest shadows are widened".to_owned());
    }
    if !shown.is_empty() {
        effects.push(format!("under {} texels show", shown.join(" and ")));
    }
    let cap = match capped.len() {
        0 => String::new(),
        count => format!(" In {count} of {} cases the cap makes them larger: {}.", pairs.len(), effects.join("; ")),
    };
    format!(
        "The error in the penumbra is <b>{errors}</b> of the fixed maps': texels are as large as the demand allows, no \
         smaller.{cap}"
    )
}

fn where_it_does_not_pay(rows: &[Row], trades: &[Trade]) -> String {
    let of = |wanted: Verdict| trades.iter().filter(move |trade| trade.verdict() == wanted);
    let better = "the same error in less time, or less error in the same time";
    let failing: Vec<String> = of(Verdict::DoesNotPay).map(name).collect();
    let found = match (trades.len(), failing.len()) {
        (0, _) if rows.iter().all(|row| row.total_ms().is_none()) => {
            "Unknown: the device has no timestamps.".to_owned()
        }
        (0, _) => "Unknown: two fixed sizes at least are needed to draw their curve.".to_owned(),
        (count, 0) => format!("In none of {count} cases does a fixed size do better: {better}."),
        (count, found) => format!(
            "In <b>{found}</b> of {count} cases a fixed size does better ({better}): {}. In {} the adaptive one wins.",
            failing.join(", "),
            of(Verdict::Pays).count()
        ),
    };
    // Where no fixed size compares, its absence says nothing.
    found
        + &match of(Verdict::Elsewhere).count() {
            0 => String::new(),
            count => format!(
                " In <b>{count}</b> the run cannot tell: the adaptive map is faster and coarser than every fixed one, or \
                 slower and finer. More <code>--sizes</code> would."
            ),
        }
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
            escaped(&pair.adaptive.key.scene),
            pair.adaptive.key.filter_and_share(),
            pair.fixed.sizes_words(),
            pair.adaptive.sizes_words(),
            if pair.adaptive.is_capped() { " (cap)" } else { "" },
            pair.fewer_texels(),
            ratio(pair.time_ratio()),
            ratio(pair.time_ratio_of_size(rows)),
            ratio(pair.error_ratio()),
            ratio(pair.light_error_ratio()),
            ratio(pair.frame_rate_ratio()),
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
    let class = |place: Place| if matches!(place, Place::Ratio(_)) { "" } else { " class=side" };
    let verdict = match trade.verdict() {
        Verdict::Pays => "<td class=pays>pays",
        Verdict::Even => "<td class=even>even",
        Verdict::DoesNotPay => "<td class=loses>does not pay",
        Verdict::Elsewhere => "<td class=even>incomparable",
    };
    format!(
        "<td{}>{}<td{}>{}{verdict}",
        class(trade.error_at_equal_time),
        trade.error_words(),
        class(trade.time_at_equal_error),
        trade.time_words()
    )
}

fn name(trade: &Trade) -> String {
    format!("{} {}", escaped(&trade.key.scene), trade.key.filter_and_share())
}

/// `4 to 380`, `7` where both ends print alike; the digits of large and of small numbers. `None` of no values.
fn span(values: impl Iterator<Item = f64>, digits: usize, digits_below_10: usize) -> Option<String> {
    let ends = |ends: Option<[f64; 2]>, value: f64| {
        Some(ends.map_or([value; 2], |[least, most]| [least.min(value), most.max(value)]))
    };
    let word =
        |value: f64| if value < 10.0 { format!("{value:.digits_below_10$}") } else { format!("{value:.digits$}") };
    let [least, most] = values.fold(None, ends)?.map(word);
    Some(if least == most { least } else { format!("{least} to {most}") })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples::{map, row};
    use crate::bench::pair::pairs;
    use crate::bench::trade::trades;

    fn of(rows: &[Row]) -> String {
        summary(rows, &pairs(rows), &trades(rows), AtCap::Widen)
    }

    #[test]
    fn a_span_says_one_number_once() {
        assert_eq!(span([2.0, 40.4].into_iter(), 0, 1), Some("2.0 to 40".into()));
        assert_eq!(span([0.5, 0.501].into_iter(), 2, 2), Some("0.50".into()));
        assert_eq!(span([].into_iter(), 2, 2), None);
    }

    #[test]
    fn the_cases_in_which_it_does_not_pay_are_named() {
        let mut rows = Vec::new();
        for scene in ["yard", "a<b"] {
            rows.extend([row(scene, "pcf", "1024", 10.0, 0.1), row(scene, "pcf", "2048", 40.0, 0.05)]);
        }
        rows.extend([row("a<b", "pcf", "adaptive@0.01", 30.0, 0.09), row("yard", "pcf", "adaptive", 12.0, 0.06)]);
        let html = of(&rows);
        assert!(html.contains("In <b>1</b> of 2 cases") && html.contains("same time): a&lt;b pcf @0.01."), "{html}");
        assert!(html.contains("pays") && html.contains("takes <b>0.30 to 0.75</b> of their time"), "{html}");
        assert!(html.contains("fixed maps of 2048,") && !html.contains("cap") && !html.contains("a<b"), "{html}");
        assert!(!html.contains("cannot tell"), "{html}");
    }

    #[test]
    fn where_no_fixed_size_compares_the_page_says_that_it_cannot_tell() {
        let fixed = [row("yard", "pcf", "1024", 10.0, 0.1), row("yard", "pcf", "2048", 40.0, 0.05)];
        let rows = [fixed.as_slice(), &[row("yard", "pcf", "adaptive@0.05", 5.0, 0.2)]].concat();
        let html = of(&rows);
        assert!(html.contains("In none of 1 cases") && html.contains("In <b>1</b> the run cannot tell"), "{html}");
        assert!(html.contains("<b>@0.05</b> lets the narrowest 5 % of the penumbra"), "{html}");
    }

    #[test]
    fn a_map_at_its_cap_says_what_its_filter_does_there() {
        let mut rows = Vec::new();
        for method in ["pcf", "pcss"] {
            rows.extend(["2048", "adaptive"].map(|size| row("yard", method, size, 10.0, 0.1)));
        }
        for (capped, words) in [
            (1, "In 1 of 2 cases the cap makes them larger: under pcf texels show."),
            (
                3,
                "In 2 of 2 cases the cap makes them larger: under pcss the narrowest shadows are widened; under pcf texels show.",
            ),
        ] {
            rows[capped].maps = vec![map([1024, 1024], true)];
            assert!(of(&rows).contains(words), "{}", of(&rows));
        }
        let smooth = summary(&rows, &pairs(&rows), &trades(&rows), AtCap::ShowTexels);
        assert!(smooth.contains("larger: under pcf and pcss texels show."), "{smooth}");
    }

    #[test]
    fn what_a_run_lacks_is_said_instead_of_numbers() {
        for sizes in [&["adaptive"][..], &["2048"], &[]] {
            let rows: Vec<Row> = sizes.iter().map(|size| row("yard", "pcf", size, 10.0, 0.1)).collect();
            let html = of(&rows);
            assert!(
                html.starts_with("<p>No adaptive map stands beside a fixed one") && !html.contains("<td>"),
                "{html}"
            );
        }
        let mut rows = ["1024", "2048", "adaptive"].map(|size| row("yard", "pcf", size, 10.0, 0.1));
        assert!(of(&rows[1..]).contains("two fixed sizes at least"));
        for row in &mut rows {
            row.times_ms.clear();
            row.comparison.penumbra.pixels = 0;
        }
        rows[2].texels = 2 * 2048 * 2048;
        let html = of(&rows);
        assert!(html.contains("<b>0.5</b> times fewer texels (below 1: more)"), "{html}");
        assert!(html.matches("the device has no timestamps").count() == 2 && html.contains("no penumbra"), "{html}");
    }
}
