//! Where maneuvers, one harder than the other, stop succeeding.

/// After a success, a step towards harder values: so much of a quantity that is harder when
/// smaller, and its inverse of the other kind. Short enough for a plan to be a start for the next.
const HARDER: f64 = 0.75;
/// After a success where it was said to be, so much of the resolution: rounded, it is within it.
const NEXT: f64 = 0.9;
/// After a failure without any success, a step towards easier values.
const EASIER: f64 = 2.0;

/// How close a frontier is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Resolution {
    /// As a share of the value.
    Share(f64),
    /// In the value's unit.
    Absolute(f64),
}

/// The values of a quantity that may be tried, all positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    /// Where the search begins.
    pub(super) first: f64,
    /// The end where success is likeliest.
    pub(super) easiest: f64,
    /// The other end.
    pub(super) hardest: f64,
    pub(super) resolution: Resolution,
}

/// What is known about the values of a line.
///
/// From the first value the search goes towards easier ones until one succeeds, from there towards
/// harder ones until one fails, and halves what lies between. So every value tried between the
/// easiest success and the last one succeeded too; of values that were not tried nothing is known,
/// since what is harder need not fail.
///
/// Where it is said what to aim at, the search begins there: where that succeeds, it goes on by
/// nearly the resolution and then twice as far each time, and where it fails, to the first value.
#[derive(Clone, Debug)]
pub(super) struct Frontier {
    line: Line,
    /// Where the edge is said to be, and is looked for first.
    aim: Option<f64>,
    /// The hardest success.
    pub(super) pass: Option<f64>,
    /// The easiest failure.
    pub(super) fail: Option<f64>,
}

impl Frontier {
    pub(super) fn new(line: Line, aim: Option<f64>) -> Self {
        let mut frontier = Self { line, aim: None, pass: None, fail: None };
        // On the easy side of it, by half the resolution.
        let aim = aim.map(|aim| frontier.shifted(aim, -0.5));
        frontier.aim = aim.filter(|aim| frontier.is_on_the_way(*aim));
        frontier
    }

    pub(super) fn record(&mut self, value: f64, succeeded: bool) {
        match succeeded {
            true => self.pass = Some(value),
            false => self.fail = Some(value),
        }
    }

    /// The value to try next; none once the frontier is as narrow as asked or an end is reached.
    pub(super) fn next(&self) -> Option<f64> {
        match (self.pass, self.fail) {
            (None, None) => Some(self.aim.unwrap_or(self.line.first)),
            (None, Some(fail)) if self.aim == Some(fail) => Some(self.line.first),
            (None, Some(fail)) => self.easier(fail),
            (Some(pass), None) => self.beyond_aim(pass).or_else(|| self.harder(pass, None)),
            (Some(pass), fail) => self.harder(pass, fail),
        }
    }

    /// Where to go on from a success at the aim or beyond it: as far again as it is from there, and no farther than a step.
    fn beyond_aim(&self, pass: f64) -> Option<f64> {
        let aim = self.aim?;
        let gone = (pass - aim).abs() / self.resolution_at(pass);
        let next = self.shifted(pass, gone.max(NEXT));
        let step = self.harder(pass, None)?;
        ((next - pass).abs() < (step - pass).abs()).then_some(next)
    }

    fn easier(&self, fail: f64) -> Option<f64> {
        let Line { easiest, .. } = self.line;
        let is_at_end = fail == easiest;
        let value = match self.is_harder_when_smaller() {
            true => (EASIER * fail).min(easiest),
            false => (fail / EASIER).max(easiest),
        };
        (!is_at_end).then_some(value)
    }

    fn harder(&self, pass: f64, fail: Option<f64>) -> Option<f64> {
        let hardest = self.line.hardest;
        let resolution = self.resolution_at(pass);
        let (step, end) = match self.is_harder_when_smaller() {
            true => (pass * HARDER - pass, hardest - pass),
            false => (pass / HARDER - pass, hardest - pass),
        };
        let half = match fail {
            Some(fail) if (fail - pass).abs() <= resolution => return None,
            Some(fail) => 0.5 * (fail - pass),
            None => end,
        };
        if end == 0.0 {
            return None;
        }
        let shift = [step, half, end].into_iter().min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        if shift == end {
            return Some(hardest);
        }
        Some(round(pass + shift, resolution))
    }

    /// A value that is harder by so many times the resolution.
    fn shifted(&self, value: f64, by: f64) -> f64 {
        let resolution = self.resolution_at(value);
        let sign = if self.is_harder_when_smaller() { -1.0 } else { 1.0 };
        round(value + sign * by * resolution, resolution)
    }

    fn resolution_at(&self, value: f64) -> f64 {
        match self.line.resolution {
            Resolution::Share(share) => share * value,
            Resolution::Absolute(width) => width,
        }
    }

    /// Whether a value lies between the first and the hardest.
    fn is_on_the_way(&self, value: f64) -> bool {
        let Line { first, hardest, .. } = self.line;
        first.min(hardest) < value && value < first.max(hardest)
    }

    fn is_harder_when_smaller(&self) -> bool {
        self.line.hardest < self.line.easiest
    }
}

/// A value that reads well, changed by a tenth of the resolution at most.
fn round(value: f64, resolution: f64) -> f64 {
    let digits = (5.0 / resolution).log10().ceil().clamp(0.0, 12.0);
    let scale = 10f64.powf(digits);
    (value * scale).round() / scale
}

#[cfg(test)]
mod tests {
    use super::*;

    const DURATIONS: Line =
        Line { first: 30.0, easiest: 480.0, hardest: 0.3, resolution: Resolution::Share(0.01) };
    const ANGLES: Line =
        Line { first: 20.0, easiest: 0.5, hardest: 180.0, resolution: Resolution::Absolute(0.5) };

    /// The frontier and every value tried on the way.
    fn search(line: Line, succeeds: impl Fn(f64) -> bool) -> (Frontier, Vec<f64>) {
        search_at(line, None, succeeds)
    }

    fn search_at(
        line: Line,
        aim: Option<f64>,
        succeeds: impl Fn(f64) -> bool,
    ) -> (Frontier, Vec<f64>) {
        let mut frontier = Frontier::new(line, aim);
        let mut tried = Vec::new();
        while let Some(value) = frontier.next() {
            assert!(tried.len() < 60 && !tried.contains(&value), "{tried:?} {value}");
            tried.push(value);
            frontier.record(value, succeeds(value));
        }
        (frontier, tried)
    }

    #[test]
    fn the_smallest_success_is_found_from_above_and_below() {
        for least in [0.7, 8.77, 29.9, 30.1, 75.0, 470.0] {
            let (frontier, tried) = search(DURATIONS, |value| value >= least);
            let (pass, fail) = (frontier.pass.unwrap(), frontier.fail.unwrap());
            assert!(fail < least && least <= pass, "{fail} {least} {pass}");
            assert!(pass - fail <= 0.01 * pass, "{fail} {pass}");
            assert!(tried.len() < 22, "{tried:?}");
        }
    }

    #[test]
    fn the_largest_success_is_found_from_below_and_above() {
        for most in [0.6, 3.0, 19.0, 21.0, 47.3, 179.0] {
            let (frontier, _) = search(ANGLES, |value| value <= most);
            let (pass, fail) = (frontier.pass.unwrap(), frontier.fail.unwrap());
            assert!(pass <= most && most < fail && fail - pass <= 0.5, "{pass} {most} {fail}");
        }
    }

    #[test]
    fn the_search_ends_at_the_ends() {
        let (frontier, tried) = search(DURATIONS, |_| false);
        assert_eq!((frontier.pass, frontier.fail), (None, Some(480.0)));
        assert_eq!(tried, [30.0, 60.0, 120.0, 240.0, 480.0]);
        let (frontier, _) = search(DURATIONS, |_| true);
        assert_eq!((frontier.pass, frontier.fail), (Some(0.3), None));
        let (frontier, _) = search(ANGLES, |_| true);
        assert_eq!((frontier.pass, frontier.fail), (Some(180.0), None));
        let (frontier, tried) = search(ANGLES, |_| false);
        assert_eq!((frontier.pass, frontier.fail), (None, Some(0.5)));
        assert_eq!(tried, [20.0, 10.0, 5.0, 2.5, 1.25, 0.625, 0.5]);
    }

    #[test]
    fn an_island_beyond_the_first_failure_is_not_taken_for_the_frontier() {
        let (frontier, tried) =
            search(DURATIONS, |value| value >= 10.0 || (4.0..7.0).contains(&value));
        assert!((10.0..10.2).contains(&frontier.pass.unwrap()), "{tried:?}");
    }

    #[test]
    fn an_aim_that_is_right_takes_two_tries_and_a_wrong_one_is_left() {
        let (frontier, tried) = search_at(DURATIONS, Some(8.77), |value| value >= 8.77);
        assert_eq!(tried, [8.81, 8.73]);
        assert_eq!((frontier.pass, frontier.fail), (Some(8.81), Some(8.73)));
        let (_, tried) = search_at(DURATIONS, Some(9.0), |value| value >= 8.77);
        assert_eq!(tried.len(), 5, "{tried:?}");
        for aim in [3.0, 8.0, 9.5, 25.0, 29.99, 0.31] {
            let (frontier, tried) = search_at(DURATIONS, Some(aim), |value| value >= 8.77);
            let (pass, fail) = (frontier.pass.unwrap(), frontier.fail.unwrap());
            assert!(
                fail < 8.77 && 8.77 <= pass && pass - fail <= 0.0101 * pass,
                "{aim}: {tried:?}"
            );
        }
        // Beyond the ends it says nothing.
        let (_, tried) = search_at(DURATIONS, Some(31.0), |value| value >= 8.77);
        assert_eq!(tried[0], 30.0);
    }

    #[test]
    fn values_read_well() {
        let (_, tried) = search(DURATIONS, |value| value >= 8.77);
        assert_eq!(tried[..5], [30.0, 22.5, 16.88, 12.66, 9.5]);
    }
}
