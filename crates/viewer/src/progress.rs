//! How far long steps are, on a terminal.

use std::sync::LazyLock;

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

/// All bars stand below one another.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// A bar on standard error; nothing is drawn where that is no terminal.
pub fn progress(message: &str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:32} {wide_bar} {percent:>3} % {eta:>4}");
    let bar = ProgressBar::new(length).with_message(message.to_owned());
    BARS.add(match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    })
}

/// A line on standard output, above the bars.
pub fn say(line: impl std::fmt::Display) {
    BARS.suspend(|| println!("{line}"));
}
