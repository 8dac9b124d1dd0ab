//! What changes on the way, in numbers: pops, shimmer, and whether any frame is slower than the fixed map's.

use crate::bench::cell::ratio;
use crate::bench::report::escaped;
use crate::bench::walk::{Points, Walk};
use crate::statistics::Spread;

/// The table of all paths.
pub fn table(walks: &[Walk]) -> String {
    let mut html = String::from(
        "<div class=wide><table><thead><tr><th>Scene<th>Filter<th>Path<th>Changes<br>of size<th>Change at<br>a change of size\
         <th>Change<br>without one<th>Shimmer,<br>adaptive<th>Shimmer,<br>fixed<th>Time over fixed,<br>median<th>slowest frame\
         <th>Maps drawn<br>if kept<th>Time over<br>redrawn, median</thead><tbody>",
    );
    for walk in walks {
        let ratios = walk.time_ratios();
        let kept = Spread::of(&walk.kept_time_ratios());
        let [drawn, skipped] = walk.kept_passes();
        let points = walk.adaptive_points.as_ref();
        html += &format!(
            "<tr><td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{drawn} of {}<td>{}",
            escaped(&walk.key.scene),
            walk.key.filter(),
            walk.path,
            walk.switches(),
            share(points.filter(|points| points.pop.switches > 0).map(|points| points.pop.switch_mean)),
            share(points.map(|points| points.pop.steady_mean)),
            share(points.map(shimmer)),
            share(walk.fixed_points.as_ref().map(shimmer)),
            ratio(Spread::of(&ratios).map(|spread| spread.median)),
            ratio(ratios.iter().copied().max_by(f64::total_cmp)),
            drawn + skipped,
            ratio(kept.map(|spread| spread.median)),
        );
    }
    html + "</tbody></table></div><p class=note>Changes are those of the visibility at fixed points of the world between two \
            frames (root mean square); shimmer is its standard deviation over the frames. With <b>sweep</b> the light moves, so \
            that they hold its motion too. A point sees the same kernel all the time. The last two columns are of adaptive maps whose boxes are \
            on steps, so that a map is drawn only when the view has left its box.</p>"
}

fn shimmer(points: &Points) -> f64 {
    points.shimmer.rms
}

fn share(value: Option<f64>) -> String {
    value.map_or(
        "-".into(),
        |value| if value > 0.0 && value < 1e-4 { format!("{value:.0e}") } else { format!("{value:.4}") },
    )
}
