// SPDX-License-Identifier: Apache-2.0
//! Rectangles of pixels.

/// Pixels from `(x0, y0)` up to, and without, `(x1, y1)`. Row 0 is the top.
///
/// ```
/// let rect = bdpt::Rect::new(0, 0, 64, 32);
/// assert_eq!((rect.width(), rect.height()), (64, 32));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rect {
    /// The first column.
    pub x0: u32,
    /// The first row.
    pub y0: u32,
    /// One past the last column.
    pub x1: u32,
    /// One past the last row.
    pub y1: u32,
}

impl Rect {
    /// A rectangle by its corners.
    pub const fn new(x0: u32, y0: u32, x1: u32, y1: u32) -> Self {
        Self { x0, y0, x1, y1 }
    }
    /// Columns.
    pub const fn width(&self) -> u32 {
        self.x1.saturating_sub(self.x0)
    }
    /// Rows.
    pub const fn height(&self) -> u32 {
        self.y1.saturating_sub(self.y0)
    }
    pub(crate) const fn raw(&self) -> [u32; 4] {
        [self.x0, self.y0, self.x1, self.y1]
    }
}
