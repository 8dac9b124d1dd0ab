//! Pop: how much more a picture changes when the map changes its size than when it does not.
//!
//! ```text
//! change_t = sqrt(mean over the mask of (V_t - V_(t-1))^2)
//! ```
//! V: visibility. The changes at switches are set against all others, which hold the motion of camera and light. The
//! root of the mean square is taken because a pop is a small part of the picture that changes much.

use crate::Error;

/// Changes between consecutive frames, in shares of full light.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Pop {
    /// Frames with another size than the frame before.
    pub switches: usize,
    /// Mean change at a switch, 0 to 1; 0 without one.
    pub switch_mean: f64,
    /// Largest change at a switch.
    pub switch_max: f64,
    /// Mean change between two frames of one size; 0 without such frames.
    pub steady_mean: f64,
    /// Largest change between two frames of one size.
    pub steady_max: f64,
    /// `switch_mean / steady_mean`: 1 where switches do not stand out. `None` (null in JSON) without switches, and where
    /// nothing changes between them.
    pub ratio: Option<f64>,
}

/// Compares consecutive frames of visibility where the mask is set; `switches` are the indices of the frames whose size
/// differs from that of the frame before. Under an empty mask nothing changes.
///
/// # Errors
/// Frames with another number of pixels than the mask, values inside the mask that are not finite, and switches that
/// are not frames with a frame before.
pub fn pop(frames: &[Vec<f32>], switches: &[usize], mask: &[bool]) -> Result<Pop, Error> {
    for (frame, picture) in frames.iter().enumerate() {
        check_frame(frame, picture, mask)?;
    }
    if let Some(&found) = switches.iter().find(|&&frame| frame == 0 || frame >= frames.len()) {
        return Err(Error::Switch { found, frames: frames.len() });
    }
    let changes = frames.windows(2).zip(1..).map(|(pair, frame)| (frame, change(&pair[0], &pair[1], mask)));
    let (at_switches, steady): (Vec<_>, Vec<_>) = changes.partition(|(frame, _)| switches.contains(frame));
    let (switch_mean, switch_max) = mean_and_max(&at_switches);
    let (steady_mean, steady_max) = mean_and_max(&steady);
    let has_ratio = !at_switches.is_empty() && steady_mean > 0.0;
    Ok(Pop {
        switches: at_switches.len(),
        switch_mean,
        switch_max,
        steady_mean,
        steady_max,
        ratio: has_ratio.then(|| switch_mean / steady_mean),
    })
}

fn check_frame(frame: usize, picture: &[f32], mask: &[bool]) -> Result<(), Error> {
    if picture.len() != mask.len() {
        return Err(Error::Count { found: picture.len(), allowed: mask.len() });
    }
    match (0..mask.len()).find(|&pixel| mask[pixel] && !picture[pixel].is_finite()) {
        Some(pixel) => Err(Error::Frame { frame, pixel, found: picture[pixel] }),
        None => Ok(()),
    }
}

fn change(before: &[f32], after: &[f32], mask: &[bool]) -> f64 {
    let inside = before.iter().zip(after).zip(mask).filter(|(_, inside)| **inside);
    let squares: Vec<f64> = inside.map(|((&b, &a), _)| (f64::from(a) - f64::from(b)).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}

/// Zeros of nothing.
fn mean_and_max(changes: &[(usize, f64)]) -> (f64, f64) {
    let (sum, max) = changes.iter().fold((0.0, 0.0f64), |(sum, max), &(_, change)| (sum + change, max.max(change)));
    (sum / changes.len().max(1) as f64, max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_at_a_switch_stands_out_of_a_steady_change() {
        // Grows by 1/64 a frame, and by 1/4 at frame 3.
        let frames: Vec<Vec<f32>> = [0.0, 1.0, 2.0, 18.0, 19.0].map(|level: f32| vec![level / 64.0; 3]).to_vec();
        let found = pop(&frames, &[3], &[true; 3]).unwrap();
        let steady = 1.0 / 64.0;
        let known = Pop {
            switches: 1,
            switch_mean: 0.25,
            switch_max: 0.25,
            steady_mean: steady,
            steady_max: steady,
            ratio: Some(16.0),
        };
        assert_eq!(found, known);
    }

    #[test]
    fn a_switch_that_changes_no_more_than_motion_does_has_the_ratio_one() {
        let frames: Vec<Vec<f32>> = (0..9).map(|t| vec![t as f32 / 8.0, 1.0 - t as f32 / 8.0]).collect();
        let found = pop(&frames, &[2, 6], &[true; 2]).unwrap();
        assert_eq!((found.switches, found.ratio), (2, Some(1.0)));
    }

    #[test]
    fn a_pop_of_a_part_of_the_picture_is_the_root_of_its_share() {
        let (before, mut after) = (vec![0.0; 100], vec![0.0; 100]);
        after[..4].fill(0.5);
        let found = pop(&[before, after], &[1], &[true; 100]).unwrap();
        assert!((found.switch_max - 0.1).abs() < 1e-12, "{found:?}");
        assert_eq!((found.steady_mean, found.ratio), (0.0, None));
    }

    #[test]
    fn what_is_outside_of_the_mask_does_not_pop() {
        let frames = [vec![0.0, f32::NAN], vec![0.0, 1.0]];
        assert_eq!(pop(&frames, &[1], &[true, false]).unwrap().switch_max, 0.0);
        assert_eq!(pop(&frames, &[1], &[false; 2]).unwrap().switch_max, 0.0);
        assert_eq!(pop(&[], &[], &[true]).unwrap().switches, 0);
    }

    #[test]
    fn frames_that_make_no_series_are_refused() {
        let nan = pop(&[vec![0.0; 2], vec![0.0, f32::NAN]], &[], &[true; 2]).unwrap_err();
        assert!(nan.to_string().starts_with("pixel 1 of frame 1 is NaN"), "{nan}");
        let count = pop(&[vec![0.0; 3]], &[], &[true; 2]).unwrap_err();
        assert!(matches!(count, Error::Count { found: 3, allowed: 2 }));
        for switch in [0, 2] {
            let error = pop(&[vec![0.0], vec![0.0]], &[switch], &[true]).unwrap_err();
            assert!(matches!(error, Error::Switch { frames: 2, .. }), "{error}");
        }
    }
}
