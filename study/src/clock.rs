//! Time within a session: seconds since it began, which never run backwards.
//!
//! A computer's clock can be set, a session's must not: within a run of the program time is that of a
//! monotonic counter, and a session that is taken up again goes on from the last moment its record tells,
//! plus the age of the interruption as far as the clock says that there was one.
//!
//! On some systems, Linux among them, the counter stands still while the computer sleeps. A pause has lasted the
//! longer of what the counter and what the clock says, and the session's time goes on by that.

use std::time::Instant;

use jiff::Timestamp;

/// Seconds since the session began.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    base_secs: f64,
    since: Instant,
}

/// One moment by both: the counter, which nobody can set, and the clock, which goes on while the computer sleeps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    counted: Instant,
    at: Timestamp,
}

impl Mark {
    /// This moment.
    pub(crate) fn now() -> Self {
        Self { counted: Instant::now(), at: Timestamp::now() }
    }
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

    /// How long a pause of this run of the program has lasted, in seconds. What of it the computer slept through is
    /// added to the time of every later moment.
    pub(crate) fn end_pause(&mut self, began: Mark, ended: Mark) -> f64 {
        let counted_secs = ended.counted.saturating_duration_since(began.counted).as_secs_f64();
        let slept_secs = (secs_between(began.at, ended.at) - counted_secs).max(0.0);
        self.base_secs += slept_secs;
        counted_secs + slept_secs
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
    use jiff::SignedDuration;
    use std::time::Duration;

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

    #[test]
    fn an_hour_asleep_in_a_pause_is_an_hour_of_the_session_and_a_clock_set_back_is_none() {
        let began = Mark::now();
        let counted_secs = 20.0;
        for (wall_secs, lasted_secs) in [(3620, 3620.0), (20, 20.0), (-7200, 20.0)] {
            let ended = Mark {
                counted: began.counted + Duration::from_secs_f64(counted_secs),
                at: began.at + SignedDuration::from_secs(wall_secs),
            };
            let mut clock = Clock { base_secs: 100.0, since: began.counted };
            assert!((clock.end_pause(began, ended) - lasted_secs).abs() < 1e-6, "{wall_secs}");
            assert!((clock.at(ended.counted) - 100.0 - lasted_secs).abs() < 1e-6, "{wall_secs}");
        }
    }
}
