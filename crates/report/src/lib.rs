//! Figures and summaries of solved maneuvers.
