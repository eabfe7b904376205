// Keeps the first switches of a cell. Twin: src/stepping/log.rs. A sweep whose switches are not needed
// uses quiet.wgsl in its place.

override events_kept: u32 = 16u;

struct Event {
    motion: Motion,
    fraction: real,
    kind: u32,
    step: u32,
    mode: u32,
    padding: u32,
}

@group(0) @binding(6) var<storage, read_write> events: array<Event>;

fn switched(state: ptr<function, State>, kind: u32, fraction: real) {
    if kind == NOTHING || kind == KINK {
        return;
    }
    // Uplifts and impacts are counted as they happen, so that the counts number them.
    var number = (*state).impacts + (*state).uplifts;
    if kind != OVERTURN {
        number -= 1u;
    }
    if number < events_kept {
        let place = lane * events_kept + number;
        events[place] = Event((*state).motion, fraction, kind, (*state).step, (*state).mode, 0u);
    }
}
