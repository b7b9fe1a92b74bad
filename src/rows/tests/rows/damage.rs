//! Damaged streams of Arrow.

use verne_rows::{Column, Format, Reader};

use crate::{NUMBERS, read, write};

fn stream() -> Vec<u8> {
    let columns = [
        Column::texts("id", (0..50).map(|i| Some(i.to_string()))),
        Column::numbers("x", (0..50).map(|i| Some(f64::from(i)))),
    ];
    write(Format::Arrow, [&columns[..], &columns[..]])
}

#[test]
fn a_truncated_stream_is_reported() {
    let stream = stream();
    let mut complete = 0;
    for length in 0..stream.len() {
        match read(Format::Arrow, &stream[..length]) {
            // Arrow allows a stream to end after any message.
            Ok(chunks) => {
                complete += 1;
                assert!(chunks.len() <= 2, "{length}");
            }
            Err(error) => assert!(error.to_string().contains("the Arrow stream cannot be read"), "{error}"),
        }
    }
    assert_eq!(complete, 3, "after the schema, and after each batch");
}

#[test]
fn damaged_bytes_never_panic() {
    let stream = stream();
    for at in 0..stream.len() {
        for byte in [0, 1, 0x7F, 0xFF] {
            let mut damaged = stream.clone();
            damaged[at] = byte;
            drop(read(Format::Arrow, &damaged));
        }
    }
}

#[test]
fn other_bytes_are_named() {
    for (bytes, detail) in [
        (&b"x,y,z\n1,2,3\n"[..], "begins with no message"),
        (b"ARROW1\0\0and more", "file of Arrow"),
        (b"", "no schema"),
    ] {
        let error = read(Format::Arrow, bytes).unwrap_err().to_string();
        assert!(error.contains(detail), "{error}");
    }
    let mut longer = stream();
    longer.push(0);
    assert!(read(Format::Arrow, &longer).unwrap_err().to_string().contains("bytes follow its end"));
}

#[test]
fn a_large_batch_is_refused_before_it_is_in_memory() {
    let columns = [Column::numbers("x", (0..10_000).map(|i| Some(f64::from(i))))];
    let stream = write(Format::Arrow, [&columns[..]]);
    let mut reader = Reader::new(Format::Arrow, NUMBERS, 10_000);
    // The schema and the head of the batch.
    reader.push(&stream[..1000]);
    let error = reader.next_chunk().unwrap_err().to_string();
    assert!(error.contains("smaller batches"), "{error}");
}
