use topple_explore::room::{MOST, Room};

#[test]
fn room_that_is_left_is_free_again_and_more_than_all_is_refused() {
    let room = Room::default();
    let all = room.take(MOST).unwrap();
    let line = room.take(1).unwrap_err().line;
    assert!(line.contains("more than 4 GiB"), "{line}");
    drop(all);
    let _half = room.take(MOST / 2).unwrap();
    assert!(room.take(u64::MAX).is_err() && room.take(MOST / 2 + 1).is_err());
    assert!(room.take(MOST / 2).is_ok());
}
