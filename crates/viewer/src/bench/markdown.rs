//! bench.md: the run as two tables for a repository, where results of many devices stand beside one another.

use std::fmt::Write;

use crate::bench::cell::{number, percent, ratio};
use crate::bench::pair::{Pair, pairs};
use crate::bench::record::BenchRecord;
use crate::bench::row::Row;
use crate::bench::trade::{Trade, trades};
use crate::statistics::Spread;

/// By this a run knows the tables of a former one.
pub const MARKDOWN_MARK: &str = "<!-- scumble-viewer bench -->";

/// The page.
pub fn markdown(record: &BenchRecord) -> String {
    let (options, machine) = (&record.options, &record.machine);
    let mut page = format!(
        "{MARKDOWN_MARK}\n# {}\n\n{}, {}; scumble {}{}. {} x {} pixels, medians (quartiles) of {} frames in which the sizes took \
         turns; the ratio is {} ({}). Adaptive maps have {} texels a side at most.\n",
        machine.device,
        machine.driver,
        machine.backend,
        machine.version,
        machine.git_commit.as_ref().map_or_else(String::new, |commit| format!(" ({commit})")),
        options.width,
        options.height,
        options.frames,
        record.ratio.value,
        record.ratio.source,
        options.cap,
    );
    let pairs = pairs(&record.rows);
    if !pairs.is_empty() {
        page += &against_fixed(&pairs, record);
    }
    page += "\n## All sizes\n\n\
             | scene | filter | size | texels | million | depth, ms | moments, ms | demand, ms | evaluation, ms | total, ms | RMS, penumbra | 99 % | \
             against the light | tilted edges | violation |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for row in &record.rows {
        page += &line(row);
    }
    page
}

fn against_fixed(pairs: &[Pair<'_>], record: &BenchRecord) -> String {
    let mut table = String::from(
        "\n## Adaptive against fixed\n\n| scene | filter | fixed | adaptive | texels, times fewer | time | of it, size | RMS error, \
         penumbra | against the light | frame rate |",
    );
    // One fixed size is no curve.
    let trades = trades(&record.rows);
    table += match trades.is_empty() {
        true => "\n|---|---|---|---|---|---|---|---|---|---|\n",
        false => " error in equal time | time for equal error |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    };
    for pair in pairs {
        table += &ratios(pair, record);
        if !trades.is_empty() {
            table += &places(trades.iter().find(|trade| trade.key == pair.adaptive.key));
        }
        table.push('\n');
    }
    table += "\nAll ratios are adaptive over fixed. *Of it, size*: over a fixed map that skips filters as the adaptive one does. \
              *Frame rate*: with receivers and shading.";
    if !trades.is_empty() {
        table += " The last two are over the curve of all fixed sizes.";
    }
    if let Some(share) = pairs.iter().find_map(|pair| pair.adaptive.key.share()) {
        let _ = write!(table, " *@{share}*: that share of the penumbra's pixels, the narrowest, may show texels.");
    }
    table + "\n"
}

fn ratios(pair: &Pair<'_>, record: &BenchRecord) -> String {
    format!(
        "| {} | {} | {} | {}{} | {:.1} | {} | {} | {} | {} | {} |",
        pair.adaptive.key.scene,
        pair.adaptive.key.filter_and_share(),
        pair.fixed.sizes_words(),
        pair.adaptive.sizes_words(),
        if pair.adaptive.is_capped() { " (cap)" } else { "" },
        pair.fewer_texels(),
        ratio(pair.time_ratio()),
        ratio(pair.time_ratio_of_size(&record.rows)),
        ratio(pair.error_ratio()),
        ratio(pair.light_error_ratio()),
        ratio(pair.frame_rate_ratio()),
    )
}

/// The last cells of a row of ratios.
fn places(trade: Option<&Trade>) -> String {
    let words = |of: fn(&Trade) -> String| trade.map_or("-".into(), of);
    format!(" {} | {} |", words(Trade::error_words), words(Trade::time_words))
}

fn line(row: &Row) -> String {
    let mut line = format!(
        "| {} | {} | {} | {}{} | {:.2} |",
        row.key.scene,
        row.key.filter(),
        row.key.size,
        row.sizes_words(),
        if row.key.is_adaptive() && row.is_capped() { " (cap)" } else { "" },
        row.texels as f64 * 1e-6
    );
    for part in ["depth", "moments", "demand", "evaluation", "total"] {
        let _ = match row.times_ms.get(part) {
            Some(Spread { median, lower_quartile, upper_quartile }) => {
                write!(line, " {median:.1} ({lower_quartile:.1} to {upper_quartile:.1}) |")
            }
            None => write!(line, " - |"),
        };
    }
    let _ = writeln!(
        line,
        " {} | {} | {} | {} | {} |",
        number(row.error(), 4),
        number(row.penumbra().map(|error| error.p99), 3),
        number(row.light_error(), 4),
        percent(row.comparison.edges.map(|edges| edges.tilt_visible_share)),
        percent(row.comparison.violation_share),
    );
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples;

    #[test]
    fn every_row_of_a_table_has_the_cells_of_its_header() {
        let mut rows = vec![examples::row("yard", "none", "2048", 5.0, 0.2)];
        rows.extend(["512", "2048", "adaptive"].map(|size| examples::row("yard", "pcf", size, 9.0, 0.1)));
        rows[3].times_ms.clear();
        let page = markdown(&examples::record(rows));
        let tables: Vec<Vec<usize>> = page
            .split("\n\n")
            .filter(|part| part.starts_with('|'))
            .map(|table| table.lines().map(|line| line.matches('|').count()).collect())
            .collect();
        assert_eq!(tables.len(), 2);
        for cells in &tables {
            assert!(cells.iter().all(|count| count == &cells[0]), "{page}");
        }
        assert_eq!((tables[0].len(), tables[1].len()), (3, 6));
    }

    #[test]
    fn one_fixed_size_is_no_curve_and_has_no_columns_for_it() {
        let page = |sizes: &[&str]| {
            let rows = sizes.iter().map(|size| examples::row("yard", "pcf", size, 9.0, 0.1));
            markdown(&examples::record(rows.collect()))
        };
        assert!(page(&["512", "2048", "adaptive"]).contains("time for equal error"));
        assert!(!page(&["2048", "adaptive"]).contains("equal error"));
    }
}
