//! The first iterate (W&B section 3.6, and the options of Ipopt's sections *Initialization* and
//! *Warm Start*).

use righting_nlp::{MultiplierInitialization, Options, Problem, Start};

use crate::barrier::distances;
use crate::bound::Bound;
use crate::error::FailureReason;
use crate::iterate::Iterate;
use crate::primal_point::PrimalPoint;
use crate::program::{Program, Row};

/// How far inside of their bounds w start: absolutely, κ_1, and as a fraction of the distance of
/// the two bounds, κ_2.
#[derive(Clone, Copy)]
struct Push {
    absolute: f64,
    fraction: f64,
}

/// The first iterate of a warm start, or of a cold one but for y, which is zero. Its derivatives
/// are not evaluated yet.
pub(crate) fn first_iterate<P: Problem + ?Sized>(
    program: &mut Program<'_, P>,
    options: &Options,
    start: &Start,
) -> Result<Iterate, FailureReason> {
    let (w, y, z) = match program.scaled_multipliers(start) {
        Some((y, z)) => warm(program, options, start, y, z)?,
        None => cold(program, options, start)?,
    };
    let mut point = PrimalPoint::at(w, y.len(), z.len());
    point.evaluate(program, &z, options.mu_init)?;
    Ok(Iterate::new(point, y, z))
}

type Vectors = (Vec<f64>, Vec<f64>, Vec<f64>);

fn cold<P: Problem + ?Sized>(
    program: &mut Program<'_, P>,
    options: &Options,
    start: &Start,
) -> Result<Vectors, FailureReason> {
    let mut w = start.x.clone();
    w.resize(program.primals(), 0.0);
    let variables = program.variables();
    let push = Push { absolute: options.bound_push, fraction: options.bound_frac };
    push_inside(&program.bounds, 0..variables, push, &mut w);
    set_slacks(program, &mut w)?;
    let push = Push { absolute: options.slack_bound_push, fraction: options.slack_bound_frac };
    push_inside(&program.bounds, variables..w.len(), push, &mut w);

    let mut z = vec![options.bound_mult_init_val; program.bounds.len()];
    if options.bound_mult_init_method == MultiplierInitialization::MuBased {
        let mut away = vec![0.0; z.len()];
        distances(&program.bounds, &w, &z, options.mu_init, &mut away);
        z.iter_mut().zip(&away).for_each(|(z, distance)| *z = options.mu_init / distance);
    }
    Ok((w, vec![0.0; program.rows.len()], z))
}

/// The slacks are those of the caller's variables, before these are moved: it is there that the
/// multipliers are nearly right.
fn warm<P: Problem + ?Sized>(
    program: &mut Program<'_, P>,
    options: &Options,
    start: &Start,
    mut y: Vec<f64>,
    mut z: Vec<f64>,
) -> Result<Vectors, FailureReason> {
    let mut w = start.x.clone();
    w.resize(program.primals(), 0.0);
    let variables = program.variables();
    set_slacks(program, &mut w)?;
    let push =
        Push { absolute: options.warm_start_bound_push, fraction: options.warm_start_bound_frac };
    push_inside(&program.bounds, 0..variables, push, &mut w);
    let push = Push {
        absolute: options.warm_start_slack_bound_push,
        fraction: options.warm_start_slack_bound_frac,
    };
    push_inside(&program.bounds, variables..w.len(), push, &mut w);

    let most = options.warm_start_mult_init_max;
    if most > 0.0 {
        y.iter_mut().for_each(|y| *y = y.clamp(-most, most));
        z.iter_mut().for_each(|z| *z = z.min(most));
    }
    z.iter_mut().for_each(|z| *z = z.max(options.warm_start_mult_bound_push));
    Ok((w, y, z))
}

/// Sets each slack to its constraint's value.
fn set_slacks<P: Problem + ?Sized>(
    program: &mut Program<'_, P>,
    w: &mut [f64],
) -> Result<(), FailureReason> {
    let mut residuals = vec![0.0; program.rows.len()];
    program.residuals(w, &mut residuals)?;
    for (row, residual) in program.rows.iter().zip(&residuals) {
        if let Row::Slack(index) = *row {
            // The slack was zero.
            w[index] = *residual;
        }
    }
    Ok(())
}

/// Moves those w of `range` that are too close to a bound, or beyond it.
fn push_inside(bounds: &[Bound], range: std::ops::Range<usize>, push: Push, w: &mut [f64]) {
    let mut rest = bounds;
    while let [first, others @ ..] = rest {
        let both = others.first().filter(|other| other.index() == first.index());
        rest = if both.is_some() { &others[1..] } else { others };
        if !range.contains(&first.index()) {
            continue;
        }
        let w = &mut w[first.index()];
        let margin = |bound: &Bound| push.absolute * bound.value.abs().max(1.0);
        match both {
            None => {
                let inside = first.sign() * (*w - first.value);
                *w = first.value + first.sign() * inside.max(margin(first));
            }
            Some(upper) => {
                let most = push.fraction * (upper.value - first.value);
                let least = first.value + margin(first).min(most);
                let greatest = upper.value - margin(upper).min(most);
                *w = w.max(least).min(greatest);
            }
        }
    }
}
