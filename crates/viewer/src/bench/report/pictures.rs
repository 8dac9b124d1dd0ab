//! Pictures in place: the fixed map, the adaptive one, the truth and where each is wrong, one over the other, so that an eye
//! that rests sees what changes. They are inside of the page: colours as JPEG, error maps as they are.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use base64::encode;
use image::ImageFormat;
use image::codecs::jpeg::JpegEncoder;

use crate::bench::cell::number;
use crate::bench::pair::Pair;
use crate::bench::pictures::ERROR_FULL_SCALE;
use crate::bench::report::escaped;
use crate::bench::row::Row;

/// JPEG quality at which texels of a shadow's edge keep their contrast.
const QUALITY: u8 = 92;

/// The pictures of all pairs, those that a share leaves as they are once, under every name; `out` is the results folder.
pub fn pictures(pairs: &[Pair<'_>], out: &Path) -> Result<String> {
    let mut shown: Vec<(&Pair<'_>, String)> = Vec::new();
    for pair in pairs {
        let name = pair.adaptive.key.filter_and_share();
        match shown.iter_mut().find(|(first, _)| is_alike(first, pair)) {
            Some((_, names)) => *names += &format!(" and {name}"),
            None => shown.push((pair, name)),
        }
    }
    shown.iter().enumerate().map(|(index, (pair, names))| figure(index, pair, names, out)).collect()
}

/// Whether two adaptive maps give one picture: of one scene and filter, with the same texels and error.
fn is_alike(one: &Pair<'_>, other: &Pair<'_>) -> bool {
    let (one, other) = (one.adaptive, other.adaptive);
    one.key.is_beside(&other.key) && one.sizes_words() == other.sizes_words() && one.error() == other.error()
}

fn figure(index: usize, pair: &Pair<'_>, names: &str, out: &Path) -> Result<String> {
    let key = &pair.adaptive.key;
    let views = [
        (pair.fixed, "picture", format!("fixed {}", pair.fixed.sizes_words())),
        (pair.adaptive, "picture", format!("adaptive {}", pair.adaptive.sizes_words())),
        (pair.adaptive, "truth", "without texels".to_owned()),
        (pair.fixed, "error_map", "error, fixed".to_owned()),
        (pair.adaptive, "error_map", "error, adaptive".to_owned()),
    ];
    let (mut tabs, mut images) = (String::new(), String::new());
    for (view, (row, picture, label)) in views.iter().enumerate() {
        let Some(name) = row.pictures.get(*picture) else { continue };
        let path = out.join(name);
        let url = if *picture == "error_map" { as_it_is(&path)? } else { as_jpeg(&path)? };
        let checked = if view == 1 { " checked" } else { "" };
        tabs += &format!(
            "<input type=radio name=p{index} id=p{index}v{view} class=v{view}{checked}><label for=p{index}v{view}>{label}</label>"
        );
        images += &format!("<img loading=lazy class=v{view} alt='{}: {label}' src='{url}'>", escaped(&key.to_string()));
    }
    let error = |row: &Row| number(row.error(), 4);
    Ok(format!(
        "<figure class=views><h3>{} under {names}: {:.1} times fewer texels</h3>{tabs}<div>{images}</div>\
         <figcaption>RMS error in the penumbra: fixed {}, adaptive {}. Error maps: red too bright, blue too dark, full colour \
         at {ERROR_FULL_SCALE} of the light.</figcaption></figure>",
        escaped(&key.scene),
        pair.fewer_texels(),
        error(pair.fixed),
        error(pair.adaptive),
    ))
}

fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))
}

/// A URL that holds a PNG picture.
fn as_it_is(path: &Path) -> Result<String> {
    Ok(format!("data:image/png;base64,{}", encode(read(path)?)))
}

/// A URL that holds a PNG picture in less space.
fn as_jpeg(path: &Path) -> Result<String> {
    let picture = image::load_from_memory_with_format(&read(path)?, ImageFormat::Png)
        .with_context(|| format!("{}: is no whole PNG picture", path.display()))?;
    let mut jpeg = Vec::new();
    JpegEncoder::new_with_quality(&mut jpeg, QUALITY)
        .encode_image(&picture)
        .with_context(|| format!("{}: cannot be encoded", path.display()))?;
    Ok(format!("data:image/jpeg;base64,{}", encode(jpeg)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples::row;
    use crate::bench::pair::pairs;

    #[test]
    fn a_share_that_changes_nothing_has_no_picture_of_its_own() {
        let rows = [("2048", 0.1), ("adaptive", 0.2), ("adaptive@0.01", 0.2), ("adaptive@0.05", 0.3)];
        let rows = rows.map(|(size, error)| row("yard", "pcss", size, 9.0, error));
        let html = pictures(&pairs(&rows), Path::new("nowhere")).unwrap();
        assert_eq!(html.matches("<figure").count(), 2, "{html}");
        assert!(html.contains("yard under pcss and pcss @0.01:") && html.contains("yard under pcss @0.05:"), "{html}");
    }
}
