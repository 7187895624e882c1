//! Tables of text.

/// One line a row, its cells padded to the width of their column and two spaces apart.
pub(crate) fn aligned<const N: usize>(
    rows: &[[String; N]],
    right_aligned: [bool; N],
) -> Vec<String> {
    let width = |column: usize| {
        rows.iter().map(|row| row[column].chars().count()).max().unwrap_or_default()
    };
    let widths: [usize; N] = std::array::from_fn(width);
    rows.iter()
        .map(|row| {
            let mut text = String::new();
            for (i, cell) in row.iter().enumerate() {
                let padding = " ".repeat(widths[i] - cell.chars().count());
                let cells = if right_aligned[i] { [&padding, cell] } else { [cell, &padding] };
                let gap = if i == 0 { "" } else { "  " };
                text.extend([gap, cells[0], cells[1]]);
            }
            text.trim_end().to_owned()
        })
        .collect()
}
