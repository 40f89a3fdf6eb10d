//! The space that a report has left: it stays below its limit whatever the record holds.

/// A number of bytes that is left.
pub(in crate::report) struct Room {
    left: usize,
    /// The number of things that did not fit.
    pub left_out: u64,
}

impl Room {
    /// Room for so many bytes.
    pub fn new(left: usize) -> Room {
        Room { left, left_out: 0 }
    }

    /// Some of the room for one part of the report; [`Room::take_back`] returns what the part leaves.
    pub fn part(&mut self, most: usize) -> Room {
        let part = most.min(self.left);
        self.left -= part;
        Room::new(part)
    }

    /// Takes back what a part leaves, and its count of what was left out.
    pub fn take_back(&mut self, part: Room) {
        self.left += part.left;
        self.left_out += part.left_out;
    }

    /// All but so many bytes, which stay for what stands around; none if there are not so many.
    pub fn within(&mut self, around: usize) -> Option<Room> {
        let most = self.left.checked_sub(around)?;
        self.left = 0;
        Some(Room::new(most))
    }

    /// A start, as much as fits, and an end; nothing, and one more left out, if not even those two fit.
    pub fn frame(
        &mut self,
        start: &str,
        end: &str,
        fill: impl FnOnce(&mut Room) -> String,
    ) -> String {
        let Some(mut inner) = self.within(start.len() + end.len()) else {
            self.left_out += 1;
            return String::new();
        };
        let text = format!("{start}{}{end}", fill(&mut inner));
        self.take_back(inner);
        text
    }

    /// Bytes left.
    pub fn left(&self) -> usize {
        self.left
    }

    /// Adds a piece to a text if it fits; otherwise it is counted as left out.
    pub fn add(&mut self, text: &mut String, piece: &str) -> bool {
        let fits = piece.len() <= self.left;
        if fits {
            self.left -= piece.len();
            text.push_str(piece);
        } else {
            self.left_out += 1;
        }
        fits
    }

    /// As many pieces as fit, up to the first that does not; the others are counted.
    pub fn fill<T>(
        &mut self,
        items: impl ExactSizeIterator<Item = T>,
        mut piece: impl FnMut(T) -> String,
    ) -> String {
        let (mut text, mut waiting) = (String::new(), items.len() as u64);
        for item in items {
            if !self.add(&mut text, &piece(item)) {
                self.left_out += waiting - 1;
                break;
            }
            waiting -= 1;
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_counted_and_nothing_is_cut() {
        let mut room = Room::new(10);
        assert_eq!(room.fill([3, 3, 3, 3, 3].iter(), |n| "x".repeat(*n)), "x".repeat(9));
        assert_eq!((room.left(), room.left_out), (1, 2));
        let mut text = String::new();
        assert!(!room.add(&mut text, "ab") && text.is_empty());
        assert_eq!(room.left_out, 3);
    }

    #[test]
    fn a_part_takes_and_returns() {
        let mut room = Room::new(10);
        let mut part = room.part(100);
        assert_eq!((room.left(), part.left()), (0, 10));
        part.add(&mut String::new(), "abcd");
        room.take_back(part);
        assert_eq!(room.left(), 6);
    }
}
