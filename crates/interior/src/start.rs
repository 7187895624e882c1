//! The first iterate. (Wächter & Biegler 2006, section 3.6.)

use righting_nlp::{MultiplierInitialization, Options, Problem, Start};

use crate::GivesUp;
use crate::barrier::distances;
use crate::program::{Bound, Program, Row};

/// Primal and dual variables: w, the constraints' y and the bounds' z.
pub(crate) struct Iterate {
    pub(crate) w: Vec<f64>,
    pub(crate) y: Vec<f64>,
    pub(crate) z: Vec<f64>,
}

/// The first iterate of a warm start, or of a cold one but for y, which is zero.
pub(crate) fn first<P: Problem + ?Sized>(
    program: &mut Program<'_, P>,
    options: &Options,
    start: &Start,
) -> Result<Iterate, GivesUp> {
    let warm = program.scaled_multipliers(start);
    // How far inside of their bounds they start: absolutely, and as a fraction of the bounds' distance.
    let (of_variables, of_slacks) = match warm {
        None => (
            (options.bound_push, options.bound_frac),
            (options.slack_bound_push, options.slack_bound_frac),
        ),
        Some(_) => (
            (options.warm_start_bound_push, options.warm_start_bound_frac),
            (options.warm_start_slack_bound_push, options.warm_start_slack_bound_frac),
        ),
    };
    let mut w = start.x.clone();
    w.resize(program.primals(), 0.0);
    // The slacks of a warm start are those of the variables before they are moved, as in Ipopt.
    if warm.is_none() {
        push_inside(&program.bounds, 0..program.variables(), of_variables, &mut w);
    }
    let mut values = vec![0.0; program.rows.len()];
    program.residuals(&w, &mut values)?;
    for (row, value) in program.rows.iter().zip(&values) {
        if let Row::Slack(index) = *row {
            w[index] = *value;
        }
    }
    if warm.is_some() {
        push_inside(&program.bounds, 0..program.variables(), of_variables, &mut w);
    }
    push_inside(&program.bounds, program.variables()..w.len(), of_slacks, &mut w);

    if let Some((mut y, mut z)) = warm {
        let most = options.warm_start_mult_init_max;
        if most > 0.0 {
            y.iter_mut().for_each(|y| *y = y.clamp(-most, most));
            z.iter_mut().for_each(|z| *z = z.min(most));
        }
        z.iter_mut().for_each(|z| *z = z.max(options.warm_start_mult_bound_push));
        return Ok(Iterate { w, y, z });
    }
    let mut z = vec![options.bound_mult_init_val; program.bounds.len()];
    if options.bound_mult_init_method == MultiplierInitialization::MuBased {
        let mut away = vec![0.0; z.len()];
        distances(&program.bounds, &w, &z, options.mu_init, &mut away);
        z.iter_mut().zip(&away).for_each(|(z, distance)| *z = options.mu_init / distance);
    }
    Ok(Iterate { w, y: vec![0.0; program.rows.len()], z })
}

/// Moves those w of `range` that are too close to a bound, or beyond it.
fn push_inside(
    bounds: &[Bound],
    range: std::ops::Range<usize>,
    (push, fraction): (f64, f64),
    w: &mut [f64],
) {
    let mut rest = bounds;
    while let [first, others @ ..] = rest {
        let both = others.first().filter(|other| other.index() == first.index());
        rest = if both.is_some() { &others[1..] } else { others };
        if !range.contains(&first.index()) {
            continue;
        }
        let w = &mut w[first.index()];
        let margin = |bound: &Bound| push * bound.value.abs().max(1.0);
        match both {
            None => {
                let inside = first.sign() * (*w - first.value);
                *w = first.value + first.sign() * inside.max(margin(first));
            }
            Some(upper) => {
                let most = fraction * (upper.value - first.value);
                let least = first.value + margin(first).min(most);
                let greatest = upper.value - margin(upper).min(most);
                *w = w.max(least).min(greatest);
            }
        }
    }
}
