//! The display that the window is on, as far as the system tells.

use scumble_psychophysics::Display;

/// The display under the participant's window; `None` where the system names none.
pub(crate) fn display(frame: &eframe::Frame) -> Option<Display> {
    let window = frame.winit_window()?;
    let monitor = window.current_monitor()?;
    let window_px = window.inner_size();
    Some(Display {
        monitor: monitor.name(),
        width_px: monitor.size().width,
        height_px: monitor.size().height,
        scale_factor: window.scale_factor(),
        // Some systems say 0 where they do not know.
        refresh_hz: monitor.refresh_rate_millihertz().filter(|rate| *rate > 0).map(|rate| f64::from(rate) / 1000.0),
        window_px: Some([window_px.width, window_px.height]),
        px_per_degree: None,
        px_per_mm: None,
        viewing_distance_mm: None,
        luminance_table: None,
        gamma_check_level: None,
    })
}
