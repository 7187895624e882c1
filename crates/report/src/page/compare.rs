//! `compare.html`: plans side by side.

use serde::Serialize;

use super::data::PageData;
use super::{fill, in_script};
use crate::comparison::{ComparedPlan, comparison_rows};

const TEMPLATE: &str = include_str!("../../page/compare.html");
pub(super) const SCRIPT: &str = include_str!("../../page/dist/compare.js");
pub(super) const STYLE: &str = include_str!("../../page/dist/compare.css");

/// What the page says, as `page/src/compare-data.ts` mirrors it.
#[derive(Serialize)]
struct CompareData<'a> {
    plans: Vec<NamedPlan<'a>>,
    /// Rows of the table, its head first.
    rows: Vec<Vec<String>>,
}

#[derive(Serialize)]
struct NamedPlan<'a> {
    name: &'a str,
    report: PageData<'a>,
}

/// The page of plans side by side, as an HTML document that opens from disk and loads nothing: a scene each on one
/// clock, turned together, and their histories in the same plots.
pub fn compare_html(plans: &[ComparedPlan<'_>]) -> String {
    let named = plans.iter().map(|plan| NamedPlan {
        name: plan.name,
        report: PageData::new(plan.scenario, plan.solution, plan.trajectory),
    });
    let data = CompareData { plans: named.collect(), rows: comparison_rows(plans) };
    fill(TEMPLATE, &[("style", STYLE), ("data", &in_script(&data)), ("script", SCRIPT)])
}
