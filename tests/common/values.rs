//! Values of scenes and flags, good ones and others.

/// Numbers, and what only looks like one.
pub fn numbers() -> Vec<&'static str> {
    let all = "1|0.2|1.75|0.75|3|10|0|-1|-0.3|0.999999|1e-300|1e300|-0.0|nan|inf|-inf|1e999|\
               4294967296|0x10|| |1,5|1:2:3|2:1:2|1:2:0|1:1:2|:::|1:inf:2|0:5:2|\u{3c0}";
    all.split('|').collect()
}

/// Words that some key takes.
pub fn words() -> Vec<&'static str> {
    "none dual horizontal quarter-turn critical-angle /dev/null".split(' ').collect()
}
