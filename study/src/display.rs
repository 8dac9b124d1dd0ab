//! The displays that there are, as far as the system tells.

use scumble_psychophysics::Display;

/// The display under the participant's window; `None` where the system names none.
pub(crate) fn display(frame: &eframe::Frame) -> Option<Display> {
    let window = frame.winit_window()?;
    let size = window.inner_size();
    let (monitors, index) = monitors(frame);
    let monitor = monitors.into_iter().nth(index?)?;
    Some(Display { scale_factor: window.scale_factor(), window_px: Some([size.width, size.height]), ..monitor })
}

/// What tells one display from another, in words: its name, size, scale and rate, the last two rounded so that a
/// record that was read says what it said when it was written.
pub(crate) fn name(display: &Display) -> String {
    let Display { monitor, width_px, height_px, scale_factor, refresh_hz, .. } = display;
    let monitor = monitor.as_deref().unwrap_or("a monitor without a name");
    let rate = refresh_hz.map_or_else(String::new, |hz| format!(", {hz:.2} Hz"));
    format!("{monitor}, {width_px} x {height_px} pixels, scale factor {scale_factor:.2}{rate}")
}

/// Every monitor in the system's order, and the index of the one under the participant's window, where it is known.
pub(crate) fn monitors(frame: &eframe::Frame) -> (Vec<Display>, Option<usize>) {
    let Some(window) = frame.winit_window() else { return (Vec::new(), None) };
    let current = window.current_monitor();
    let index = window.available_monitors().position(|monitor| Some(monitor) == current);
    let monitors = window.available_monitors().map(|monitor| Display {
        monitor: monitor.name(),
        width_px: monitor.size().width,
        height_px: monitor.size().height,
        scale_factor: monitor.scale_factor(),
        // Some systems say 0 where they do not know.
        refresh_hz: monitor.refresh_rate_millihertz().filter(|rate| *rate > 0).map(|rate| f64::from(rate) / 1000.0),
        ..Display::default()
    });
    (monitors.collect(), index)
}
