//! The reference filters of every pattern, kernel, encoding and contrast, as a Markdown table.
//!
//! `cargo run --release -p scumble-stimuli --example reference_filter` prints the table of
//! `docs/reference-filter.md`: the ratio r / a from which no place differs by more than D levels. Of
//! steps for texels of 5, 10 and 20 pixels in a picture 600 pixels wide; `-` where only the border
//! hides them.

use scumble_stimuli::{Comparison, Encoding, Error, Kernel, Pattern, reference_ratio};

const WIDTH_PX: f64 = 600.0;
const TEXELS_PX: [f64; 3] = [5.0, 10.0, 20.0];
const CONTRASTS: [f64; 2] = [1.0, 0.5];
const TOLERANCES: [f64; 3] = [1.0, 2.0, 4.0];
const KERNELS: [&str; 4] = ["disc", "box", "gauss2", "gauss3"];
const ENCODINGS: [(&str, Encoding); 2] = [("code", Encoding::CodeValues), ("light", Encoding::LinearLight)];

fn main() -> Result<(), Error> {
    println!("| pattern | a, px | kernel | encoding | 100 %: D = 1 | D = 2 | D = 4 | 50 %: D = 1 | D = 2 | D = 4 |");
    println!("|---|---|---|---|---|---|---|---|---|---|");
    rows("stair", Pattern::Stair, None)?;
    for (name, pattern) in [("step", Pattern::Step), ("double step", Pattern::DoubleStep)] {
        for texel_px in TEXELS_PX {
            rows(name, pattern, Some(texel_px))?;
        }
    }
    Ok(())
}

/// The rows of a pattern at one size of its texel, which a stair does not ask for.
fn rows(name: &str, pattern: Pattern, texel_px: Option<f64>) -> Result<(), Error> {
    let size = texel_px.map_or("any".to_owned(), |texel_px| texel_px.to_string());
    let width_texels = WIDTH_PX / texel_px.unwrap_or(TEXELS_PX[0]);
    let kernels = KERNELS.iter().filter_map(|&name| Some((name, Kernel::from_name(name)?)));
    for (kernel_name, kernel) in kernels {
        for (encoding_name, encoding) in ENCODINGS {
            print!("| {name} | {size} | {kernel_name} | {encoding_name} |");
            for contrast in CONTRASTS {
                for tolerance in TOLERANCES {
                    let comparison = Comparison { pattern, kernel, contrast, encoding, width_texels };
                    let ratio = reference_ratio(&comparison, tolerance)?;
                    let hidden_by_border = texel_px.is_some() && ratio > 0.4999 * width_texels;
                    print!(" {} |", if hidden_by_border { "-".to_owned() } else { format!("{ratio:.2}") });
                }
            }
            println!();
        }
    }
    Ok(())
}
