//! Tables of text.

/// One line a row, its cells padded to the width of their column and two spaces apart.
pub(crate) fn aligned(rows: &[impl AsRef<[String]>], right_aligned: &[bool]) -> Vec<String> {
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row.as_ref()[column].chars().count());
        cells.max().unwrap_or_default()
    };
    let widths: Vec<usize> = (0..right_aligned.len()).map(width).collect();
    rows.iter()
        .map(|row| {
            let mut text = String::new();
            for (i, cell) in row.as_ref().iter().enumerate() {
                let padding = " ".repeat(widths[i] - cell.chars().count());
                let cells = if right_aligned[i] { [&padding, cell] } else { [cell, &padding] };
                let gap = if i == 0 { "" } else { "  " };
                text.extend([gap, cells[0], cells[1]]);
            }
            text.trim_end().to_owned()
        })
        .collect()
}
