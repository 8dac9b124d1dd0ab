//! How large a shadow map is, as the command line and the records spell it: `adaptive`, `adaptive@0.01`, `2048`,
//! `512x448`, `2048+blocks`.

use std::fmt;
use std::str::FromStr;

use scumble::Statistic;

/// Largest side of a map; the device may allow less and says so.
pub const SIDE_MAX: u32 = 16_384;
/// The size that is chosen by the screen.
const ADAPTIVE: &str = "adaptive";
/// What stands before the share of the penumbra that may show texels.
const SHARE: char = '@';
/// How a fixed size with blocks ends.
const BLOCKS: &str = "+blocks";
/// Smallest side of a map: the floor of adaptive ones.
pub const SIDE_MIN: u32 = 8;

/// How large a shadow map is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// As small as the relation allows for the radius that a statistic picks.
    Adaptive(Statistic),
    /// Texels across and down.
    Fixed([u32; 2]),
    /// Fixed, but with the demand pass of an adaptive map, which tells where one lookup is enough.
    Blocks([u32; 2]),
}

impl Size {
    /// The fixed size of this list that an adaptive one is set beside: 2048 x 2048, which most renderers' settings call
    /// high, else the one of the most texels.
    pub fn beside(sizes: &[Self]) -> Option<Self> {
        let usual = Self::Fixed([2048; 2]);
        let fixed = sizes.iter().copied().filter(|size| matches!(size, Self::Fixed(_)));
        if sizes.contains(&usual) { Some(usual) } else { fixed.max_by_key(Self::texels) }
    }

    /// Texels of a fixed size; 0 for an adaptive one, which has them from the screen.
    pub fn texels(&self) -> u64 {
        match self {
            Self::Adaptive(_) => 0,
            Self::Fixed([across, down]) | Self::Blocks([across, down]) => u64::from(*across) * u64::from(*down),
        }
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(rest) = text.strip_prefix(ADAPTIVE) {
            return statistic(rest).map(Self::Adaptive).ok_or_else(allowed);
        }
        let side = |part: &str| part.parse().ok().filter(|side| (SIDE_MIN..=SIDE_MAX).contains(side));
        let (sides, has_blocks) = match text.strip_suffix(BLOCKS) {
            Some(sides) => (sides, true),
            None => (text, false),
        };
        let (across, down) = sides.split_once('x').unwrap_or((sides, sides));
        match (side(across), side(down)) {
            (Some(across), Some(down)) if has_blocks => Ok(Self::Blocks([across, down])),
            (Some(across), Some(down)) => Ok(Self::Fixed([across, down])),
            _ => Err(allowed()),
        }
    }
}

/// The statistic behind `adaptive`: none, or a share that may show texels.
fn statistic(text: &str) -> Option<Statistic> {
    if text.is_empty() {
        return Some(Statistic::Minimum);
    }
    let share = text.strip_prefix(SHARE)?.parse().ok()?;
    Statistic::Quantile(share).checked().ok()
}

fn allowed() -> String {
    format!(
        "allowed are {ADAPTIVE}, {ADAPTIVE}{SHARE}S with a share S from 0 to below 1, and N, NxM, N{BLOCKS} or NxM{BLOCKS} with \
         sides of {SIDE_MIN} to {SIDE_MAX} texels"
    )
}

impl fmt::Display for Size {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Adaptive(Statistic::Minimum) => formatter.write_str(ADAPTIVE),
            Self::Adaptive(Statistic::Quantile(share)) => write!(formatter, "{ADAPTIVE}{SHARE}{share}"),
            Self::Fixed([across, down]) if across == down => write!(formatter, "{across}"),
            Self::Fixed([across, down]) => write!(formatter, "{across}x{down}"),
            Self::Blocks(sides) => write!(formatter, "{}{BLOCKS}", Self::Fixed(*sides)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_as_they_are_written() {
        for text in ["adaptive", "adaptive@0.01", "2048", "512x448", "2048+blocks", "512x448+blocks"] {
            assert_eq!(text.parse::<Size>().map(|size| size.to_string()), Ok(text.to_owned()));
        }
    }

    #[test]
    fn a_size_that_is_none_is_refused_with_what_is_allowed() {
        for text in [
            "",
            "x",
            "7",
            "512x",
            "x512",
            "16385",
            "-512",
            "512x512x512",
            "1e3",
            "Adaptive",
            "+blocks",
            "adaptive+blocks",
            "adaptive@1",
            "adaptive@",
            "adaptive0.01",
        ] {
            let refused = text.parse::<Size>().expect_err(text);
            assert!(refused.contains("8 to 16384"), "{refused}");
        }
    }
}
