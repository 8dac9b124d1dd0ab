//! Time within a session: seconds since it began, which never run backwards.
//!
//! A computer's clock can be set, a session's must not: within a run of the program time is that of a
//! monotonic counter, and a session that is taken up again goes on from the last moment its record tells,
//! plus the age of the interruption as far as the clock says that there was one.

use std::time::Instant;

use jiff::Timestamp;

/// Seconds since the session began.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    base_secs: f64,
    since: Instant,
}

impl Clock {
    /// A session that begins now.
    pub(crate) fn start() -> Self {
        Self { base_secs: 0.0, since: Instant::now() }
    }

    /// A session that began at `started_at`, whose record ends at `last_at`, taken up again now; and the age
    /// of the interruption in seconds, 0 where the clock stands before the end of the record.
    pub(crate) fn resume(started_at: Timestamp, last_at: Timestamp, now: Timestamp) -> (Self, f64) {
        let interrupted_secs = secs_between(last_at, now);
        let base_secs = secs_between(started_at, last_at) + interrupted_secs;
        (Self { base_secs, since: Instant::now() }, interrupted_secs)
    }

    /// Seconds since the session began, at a moment of this run of the program.
    pub(crate) fn at(&self, moment: Instant) -> f64 {
        self.base_secs + moment.saturating_duration_since(self.since).as_secs_f64()
    }
}

/// Seconds from one moment to a later one, 0 to an earlier one.
pub(crate) fn secs_between(from: Timestamp, to: Timestamp) -> f64 {
    to.duration_since(from).as_secs_f64().max(0.0)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn a_session_goes_on_where_its_record_ends_even_with_the_clock_set_back() {
        let [start, last]: [Timestamp; 2] =
            ["2026-03-01T09:00:00Z", "2026-03-01T09:10:00Z"].map(|text| text.parse().unwrap());
        for (now, age_secs) in [("2026-03-01T09:12:30Z", 150.0), ("2026-03-01T08:00:00Z", 0.0)] {
            let (clock, interrupted_secs) = Clock::resume(start, last, now.parse().unwrap());
            assert_eq!(interrupted_secs, age_secs, "{now}");
            assert!((clock.at(Instant::now()) - 600.0 - age_secs).abs() < 1.0, "{now}");
        }
    }
}
