use righting_symbolic::LANES;

/// Consecutive steps or nodes evaluated side by side, one a lane. Spare lanes repeat the last item.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block {
    first: usize,
    count: usize,
}

impl Block {
    /// The blocks that cover the items `0..items`.
    pub(crate) fn cover(items: usize) -> impl Iterator<Item = Self> {
        (0..items).step_by(LANES).map(move |first| Self { first, count: LANES.min(items - first) })
    }

    /// How many blocks cover `items` items.
    pub(crate) fn count_for(items: usize) -> usize {
        items.div_ceil(LANES)
    }

    /// `(lane, item)` of the lanes in use.
    pub(crate) fn items(self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.count).map(move |lane| (lane, self.first + lane))
    }

    /// Loads `row(item)` into each lane of a port of `width` elements.
    pub(crate) fn load<'a>(self, port: &mut [f64], width: usize, row: impl Fn(usize) -> &'a [f64]) {
        for lane in 0..LANES {
            let values = row(self.first + lane.min(self.count - 1));
            for (element, &value) in values[..width].iter().enumerate() {
                port[element * LANES + lane] = value;
            }
        }
    }
}

/// The lanes of element `index` of a port.
pub(crate) fn lanes(port: &[f64], index: usize) -> &[f64; LANES] {
    port[index * LANES..(index + 1) * LANES].try_into().expect("a port holds whole lanes")
}
