//! Double precision array files of SPICE (NAIF's DAF Required Reading): one segment, little-endian.

/// Bytes of a record.
const RECORD: usize = 1024;
/// Doubles of a record.
const WORDS: usize = RECORD / 8;
/// Characters of a comment record that are used.
const COMMENT: usize = 1000;
/// What tells whether a transfer as text has changed line ends.
const TRANSFER_CHECK: &[u8; 28] = b"FTPSTR:\r:\n:\r\n:\r\0:\x81:\x10\xce:ENDFTP";

/// A file of one segment.
pub(crate) struct Daf<'a> {
    /// Kind of the file, such as `DAF/CK`.
    pub kind: &'a str,
    /// Its name in itself.
    pub name: &'a str,
    /// Lines of printable ASCII for a reader.
    pub comments: &'a [String],
    /// Name of the segment.
    pub segment: &'a str,
    /// The doubles of its summary.
    pub summary: [f64; 2],
    /// The integers of its summary, but for the two addresses of its data.
    pub codes: [i32; 4],
    /// Its data.
    pub data: &'a [f64],
}

impl Daf<'_> {
    /// The file: its record, comments, a record of summaries, one of names, and the data.
    pub fn to_bytes(&self) -> Vec<u8> {
        let comments = self.comment_area();
        let summaries = 2 + comments.len() / RECORD;
        let first = (summaries + 1) * WORDS + 1;
        let free = first + self.data.len();
        // The two integers of a summary after the doubles; addresses count doubles from one.
        let ints = |values: &[usize]| {
            values.iter().flat_map(|v| (*v as i32).to_le_bytes()).collect::<Vec<u8>>()
        };

        let mut bytes = Vec::with_capacity((summaries + 2) * RECORD + 8 * self.data.len());
        bytes.extend(padded(self.kind, 8));
        bytes.extend(ints(&[self.summary.len(), self.codes.len() + 2]));
        bytes.extend(padded(self.name, 60));
        bytes.extend(ints(&[summaries, summaries, free]));
        bytes.extend(b"LTL-IEEE");
        bytes.extend([0; 603]);
        bytes.extend(TRANSFER_CHECK);
        bytes.extend([0; 297]);
        bytes.extend(comments);

        let mut record = Vec::with_capacity(RECORD);
        let [next, previous, count] = [0.0, 0.0, 1.0];
        for value in [next, previous, count].into_iter().chain(self.summary) {
            record.extend(f64::to_le_bytes(value));
        }
        record.extend(self.codes.iter().flat_map(|code| code.to_le_bytes()));
        record.extend(ints(&[first, free - 1]));
        record.resize(RECORD, 0);
        bytes.extend(record);
        bytes.extend(padded(self.segment, RECORD));
        bytes.extend(self.data.iter().flat_map(|value| value.to_le_bytes()));
        bytes.resize(bytes.len().next_multiple_of(RECORD), 0);
        bytes
    }

    /// Lines end with a null, all of them with an end of transmission.
    fn comment_area(&self) -> Vec<u8> {
        let mut text: Vec<u8> =
            self.comments.iter().flat_map(|line| line.bytes().chain([0])).collect();
        text.push(4);
        let records = text.chunks(COMMENT).map(|part| {
            let mut record = part.to_vec();
            record.resize(RECORD, 0);
            record
        });
        records.flatten().collect()
    }
}

/// Text with blanks up to a length, or cut there.
fn padded(text: &str, length: usize) -> Vec<u8> {
    let mut bytes: Vec<u8> = text.bytes().take(length).collect();
    bytes.resize(length, b' ');
    bytes
}
