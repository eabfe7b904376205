//! `topple explore`: who is let in, and that its numbers are those of the library and of the command line.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;
use topple::scene::builder::SceneBuilder;
use topple::scene::{Grid, Parameter, Range};
use topple::stepping::outcome::Class;
use topple::{BackendRequest, Column, ColumnValues, RunSettings, Unwatched, VerifySettings, sweep};

use crate::common::room::Room;

/// A server whose folders of temporary files lie in one of its own; ended with the test.
pub struct Server {
    pub process: Child,
    host: String,
    token: String,
    pub folder: TempDir,
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// An answer: status, headers, body.
pub struct Answer {
    pub status: u16,
    headers: String,
    body: Vec<u8>,
}

impl Answer {
    fn json(&self) -> Value {
        assert_eq!(self.status, 200, "{}", String::from_utf8_lossy(&self.body));
        serde_json::from_slice(&self.body).unwrap()
    }

    /// The frames of a view: headers, each with its arrays' bytes.
    fn frames(&self) -> Vec<(Value, Vec<Vec<u8>>)> {
        assert_eq!(self.status, 200);
        let (mut frames, mut rest) = (Vec::new(), &self.body[..]);
        while !rest.is_empty() {
            let length = u32::from_le_bytes(rest[..4].try_into().unwrap()) as usize;
            let header: Value = serde_json::from_slice(&rest[4..4 + length]).unwrap();
            rest = &rest[4 + length..];
            let mut arrays = Vec::new();
            for array in header["arrays"].as_array().unwrap() {
                let width = if array["type"] == "u8" { 1 } else { 4 };
                let bytes = array["length"].as_u64().unwrap() as usize * width;
                arrays.push(rest[..bytes].to_vec());
                rest = &rest[bytes.next_multiple_of(8)..];
            }
            // How far a stage is, is told where it takes long; no test knows whether it does.
            if header.get("progress").is_none() {
                frames.push((header, arrays));
            }
        }
        frames
    }
}

impl Server {
    /// Starts one, by another command where one is given. Its output is read up to the address, and closed.
    pub fn start(by: &[&str]) -> Server {
        let folder = TempDir::new().unwrap();
        let own = [env!("CARGO_BIN_EXE_topple"), "explore", "--no-open", "--backend", "cpu"];
        let words = [by, &own].concat();
        let mut command = Command::new(words[0]);
        command.args(&words[1..]).env("TMPDIR", folder.path()).stdin(Stdio::null());
        let mut process = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.split_whitespace().last().unwrap().strip_prefix("http://").unwrap();
        let (host, token) = address.trim_end_matches('/').split_once('/').unwrap();
        Server { host: host.into(), token: token.into(), process, folder }
    }

    /// Sends a request as it is written.
    fn send(&self, head: &str, body: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
        let length = body.len();
        write!(stream, "{head}Content-Length: {length}\r\nConnection: close\r\n\r\n").unwrap();
        stream.write_all(body).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
        let headers = String::from_utf8(bytes[..end].to_vec()).unwrap().to_lowercase();
        let status = headers.split_whitespace().nth(1).unwrap().parse().unwrap();
        let body = bytes.split_off(end + 4);
        let chunked = headers.contains("transfer-encoding: chunked");
        Answer { status, headers, body: if chunked { joined(&body) } else { body } }
    }

    fn get(&self, path: &str) -> Answer {
        let Server { host, token, .. } = self;
        self.send(&format!("GET /{token}/{path} HTTP/1.1\r\nHost: {host}\r\n"), b"")
    }

    fn post(&self, path: &str, body: &Value) -> Answer {
        self.post_bytes(path, body.to_string().as_bytes())
    }

    pub fn post_bytes(&self, path: &str, body: &[u8]) -> Answer {
        let Server { host, token, .. } = self;
        let head = format!("POST /{token}/{path} HTTP/1.1\r\nHost: {host}\r\nX-Topple: page\r\n");
        self.send(&head, body)
    }
}

/// A body that comes in chunks.
fn joined(mut rest: &[u8]) -> Vec<u8> {
    let mut body = Vec::new();
    loop {
        let end = rest.windows(2).position(|two| two == b"\r\n").unwrap();
        let length = usize::from_str_radix(std::str::from_utf8(&rest[..end]).unwrap(), 16).unwrap();
        if length == 0 {
            return body;
        }
        body.extend(&rest[end + 2..end + 2 + length]);
        rest = &rest[end + 2 + length + 2..];
    }
}

/// A file as the page sends it.
pub fn dropped(name: &str, text: &str) -> Vec<u8> {
    let header = json!([[name, text.len()]]).to_string();
    let length = (header.len() as u32).to_le_bytes();
    [&length[..], header.as_bytes(), text.as_bytes()].concat()
}

fn flat() -> Value {
    json!({
        "object": "1", "eccentricity": "0.2", "t_h": "1.75", "t_v": "0.75",
        "omega": "0.2:15", "a_h": "0.1:15", "x": "omega", "y": "a_h",
    })
}

/// The columns of the same scene by the library.
fn by_library(count: u32, columns: [Column; 2]) -> Vec<ColumnValues> {
    let scene = SceneBuilder::object(1)
        .with(Parameter::Eccentricity, 0.2)
        .with(Parameter::TH, 1.75)
        .with(Parameter::TV, 0.75)
        .with(Parameter::Omega, Range::even(0.2, 15.0, count))
        .with(Parameter::AH, Range::even(0.1, 15.0, count))
        .check()
        .unwrap();
    let mut settings = RunSettings::default();
    settings.backend = BackendRequest::Cpu;
    settings.verify = VerifySettings::cells(0);
    let mut all = sweep(&scene, &[], &settings, &Unwatched).unwrap().into_columns().unwrap();
    columns
        .map(|column| std::mem::replace(&mut all[column as usize].1, ColumnValues::Codes(vec![])))
        .into()
}

/// What an answer says of a request that is refused.
const REFUSED: &str = "x-topple: refused";

#[test]
fn nobody_is_let_in_but_the_page() {
    let server = Server::start(&[]);
    let Server { host, token, .. } = &server;
    let page = server.get("");
    assert_eq!(page.status, 200);
    assert!(
        page.headers.contains("content-security-policy: default-src 'self'"),
        "{}",
        page.headers
    );
    assert!(page.headers.contains("content-type: text/html"));
    assert_eq!(server.get("nothing.js").status, 404);
    assert_eq!(server.get("../Cargo.toml").status, 404);
    let body = json!({ "scene": flat(), "count": [9, 9] }).to_string();
    let mark = "X-Topple: page\r\n";
    for (name, head) in [
        ("no token", format!("POST /map HTTP/1.1\r\nHost: {host}\r\n{mark}")),
        (
            "another token",
            format!("POST /{}/map HTTP/1.1\r\nHost: {host}\r\n{mark}", "0".repeat(32)),
        ),
        ("another host", format!("POST /{token}/map HTTP/1.1\r\nHost: evil.example\r\n{mark}")),
        (
            "another origin",
            format!(
                "POST /{token}/map HTTP/1.1\r\nHost: {host}\r\nOrigin: http://evil.example\r\n{mark}"
            ),
        ),
        (
            "a foreign page",
            format!(
                "POST /{token}/map HTTP/1.1\r\nHost: {host}\r\nSec-Fetch-Site: cross-site\r\n{mark}"
            ),
        ),
        ("no mark", format!("POST /{token}/map HTTP/1.1\r\nHost: {host}\r\n")),
    ] {
        let answer = server.send(&head, body.as_bytes());
        assert_eq!(answer.status, 403, "{name}");
        let line = String::from_utf8(answer.body).unwrap();
        assert!(line.starts_with("not allowed: ") && line.contains("open the address"), "{line}");
    }
    let elsewhere =
        server.send(&format!("GET /{token}/ HTTP/1.1\r\nHost: machine.example\r\n"), b"");
    let line = String::from_utf8(elsewhere.body).unwrap();
    let (_, port) = host.split_once(':').unwrap();
    assert!(line.contains(&format!("ssh -L {port}:127.0.0.1:{port}")), "{line}");
    // A tunnel's own end may have another port.
    let tunnel = format!("GET /{token}/ HTTP/1.1\r\nHost: localhost:9999\r\n");
    assert_eq!(server.send(&tunnel, b"").status, 200);
    let own =
        format!("POST /{token}/map HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n{mark}");
    assert_eq!(server.send(&own, body.as_bytes()).status, 200);
}

#[test]
fn a_request_by_another_method_is_told_by_which() {
    let server = Server::start(&[]);
    let Server { host, token, .. } = &server;
    let ask = |method: &str, path: &str, more: &str| {
        let head = format!("{method} /{token}/{path} HTTP/1.1\r\nHost: {host}\r\n{more}");
        server.send(&head, b"")
    };
    let mark = "X-Topple: page\r\n";
    for (method, path, more, allow) in [
        ("OPTIONS", "", "", "get, head"),
        ("OPTIONS", "main.js", "", "get, head"),
        ("OPTIONS", "about", "", "get, head"),
        ("OPTIONS", "map", "", "post"),
        ("GET", "map", "", "post"),
        ("HEAD", "suite", "", "post"),
        ("POST", "style.css", mark, "get, head"),
        ("PUT", "about", mark, "get, head"),
        ("DELETE", "record", mark, "post"),
    ] {
        let answer = ask(method, path, more);
        assert_eq!(answer.status, 405, "{method} {path}");
        assert!(answer.headers.contains(&format!("\r\nallow: {allow}\r\n")), "{}", answer.headers);
    }
    for (method, path, more) in
        [("GET", "nothing", ""), ("OPTIONS", "nothing", ""), ("POST", "nothing", mark)]
    {
        assert_eq!(ask(method, path, more).status, 404, "{method}");
    }
    let head = ask("HEAD", "", "");
    assert!(head.status == 200 && head.body.is_empty() && head.headers.contains("text/html"));
    // A page from elsewhere that asks first whether it may.
    let foreign = "Origin: http://evil.example\r\nAccess-Control-Request-Method: POST\r\n";
    let refused = ask("OPTIONS", "map", foreign);
    assert!(refused.status == 403 && !refused.headers.contains("allow"), "{}", refused.headers);
}

/// The coarse and the fine picture are sweeps of their grids, to the last bit; the refined one has the dense sweep's
/// outcomes but in leaves, of which one in a thousand at most is missed.
#[test]
fn a_view_has_the_numbers_of_the_library() {
    let server = Server::start(&[]);
    let request = json!({ "tab": "t", "view": 1, "scene": flat(), "count": [257, 257], "columns": ["outcome", "zeta"] });
    let frames = server.post("map", &request).frames();
    let stages: Vec<&str> =
        frames.iter().map(|(header, _)| header["stage"].as_str().unwrap()).collect();
    assert_eq!(stages, ["coarse", "fine", "refined"]);
    for ((header, arrays), count) in frames.iter().zip([65, 129, 257]) {
        assert_eq!(header["shape"], json!([count, count]), "{header}");
        let [ColumnValues::Codes(codes), ColumnValues::Singles(zeta)] =
            &by_library(count, [Column::Outcome, Column::Zeta])[..]
        else {
            panic!("columns of other types");
        };
        let places: Vec<&str> = header["arrays"]
            .as_array()
            .unwrap()
            .iter()
            .map(|own| own["name"].as_str().unwrap())
            .collect();
        assert_eq!(places, ["kind", "marks", "outcome", "zeta"]);
        let differ = arrays[2].iter().zip(codes).filter(|(page, own)| page != own).count();
        if header["stage"] == "refined" {
            assert!(differ * 1000 <= codes.len(), "{differ} of {}", codes.len());
            assert!(header["cells"].as_u64().unwrap() < 257 * 257 / 4);
            continue;
        }
        assert_eq!(differ, 0, "{header}");
        let bytes: Vec<u8> = zeta.iter().flat_map(|number| number.to_le_bytes()).collect();
        assert_eq!(arrays[3], bytes, "{header}");
    }
}

#[test]
fn an_older_view_ends_when_a_newer_one_begins() {
    let server = Server::start(&[]);
    // Chaotic and stiff: every cell is run, for many seconds.
    let mut slow = flat();
    slow["t_v"] = "0.005".into();
    slow["t_max"] = "1000".into();
    let old =
        json!({ "tab": "t", "view": 1, "scene": slow, "count": [2049, 2049], "precision": "f64" });
    let began = std::time::Instant::now();
    std::thread::scope(|scope| {
        let ended = scope.spawn(|| server.post("map", &old));
        std::thread::sleep(Duration::from_millis(300));
        let new = json!({ "tab": "t", "view": 2, "scene": flat(), "count": [33, 33] });
        assert_eq!(server.post("map", &new).frames().len(), 1);
        let frames = ended.join().unwrap().frames();
        // Words of how far it was, and the coarse picture at most.
        let is_early =
            |header: &Value| header["stage"] == "coarse" || header["progress"]["stage"] == "coarse";
        let told = frames.iter().map(|(header, _)| header);
        assert!(told.clone().all(is_early), "{:?}", told.collect::<Vec<_>>());
    });
    // A view that comes late is not computed.
    assert!(server.post("map", &old).frames().is_empty());
    assert!(began.elapsed() < Duration::from_secs(30), "{:?}", began.elapsed());
}

#[test]
fn the_command_line_and_the_file_make_the_scene_in_view() {
    let server = Server::start(&[]);
    let mut scenes = vec![flat()];
    let changed = |changes: &[(&str, &str)]| {
        let mut scene = flat();
        for (key, text) in changes {
            scene[*key] = (*text).into();
        }
        scene
    };
    scenes.push(changed(&[("x", "a_h"), ("y", "omega")]));
    scenes.push(changed(&[("a_v", "-4"), ("shape", "ricker"), ("a_h", "1:15:log")]));
    scenes.push(changed(&[
        ("omega", "5"),
        ("x", "t_h"),
        ("t_h", "0.5:4"),
        ("psi", "1"),
        ("overturn", "quarter-turn"),
    ]));
    for scene in scenes {
        let request = json!({ "scene": scene, "count": [7, 5] });
        let told = server.post("command", &request).json();
        let command = told["command"].as_str().unwrap().strip_prefix("topple ").unwrap();
        let text = Room::new().run(&format!("{command} --save-scene -")).out;
        let from_flags = SceneBuilder::from_toml(&text).unwrap();
        let from_file = SceneBuilder::from_toml(told["toml"].as_str().unwrap()).unwrap();
        let [flags, file] = [&from_flags, &from_file].map(|given| given.check().unwrap());
        assert_eq!(Grid::of(&flags), Grid::of(&file), "{told}");
        let grid = Grid::of(&flags);
        assert_eq!([grid.x().key(), grid.y().unwrap().key()], [&scene["x"], &scene["y"]]);
        assert_eq!((grid.x().count(), grid.y().unwrap().count()), (7, 5));
        assert_eq!(from_flags.shape, from_file.shape);
        assert_eq!(from_flags.overturn, from_file.overturn);
    }
}

#[test]
fn a_cell_a_section_and_the_reference_agree_with_the_map() {
    let server = Server::start(&[]);
    let request = json!({ "scene": flat(), "count": [33, 33], "columns": ["outcome"] });
    let frames = server.post("map", &request).frames();
    let codes = &frames[0].1[2];
    let (low, high) = ([0.2, 0.1], [15.0, 15.0]);
    let at = |axis: usize, k: usize| low[axis] + (high[axis] - low[axis]) * k as f64 / 32.0;
    let name = |code: u8| Class::ALL[usize::from(code)].name();
    // The diagonal.
    let line = json!({ "scene": flat(), "from": low, "to": high, "count": 33 });
    let section = server.post("section", &line).json();
    for k in 0..33 {
        assert_eq!(section["outcome"][k], codes[k * 33 + k], "{k}");
    }
    for k in [4, 12, 20, 28] {
        let mut scene = flat();
        scene["omega"] = at(0, k).to_string().into();
        scene["a_h"] = at(1, k).to_string().into();
        let cell = server.post("cell", &json!({ "scene": scene, "motion": true })).json();
        assert_eq!(cell["columns"]["outcome"], name(codes[k * 33 + k]), "{k}");
        let count = cell["motion"]["t"].as_array().unwrap().len();
        assert!(count > 100 && cell["motion"]["mode"].as_array().unwrap().len() == count);
        let events = cell["events"].as_array().unwrap();
        let impacts =
            events.iter().filter(|event| event["what"] == "impact" || event["what"] == "rest");
        assert_eq!(json!(impacts.count()), cell["columns"]["impacts"], "{k}");
    }
    let verified =
        server.post("verify", &json!({ "scene": flat(), "count": [65, 65], "cells": 32 })).json();
    assert_eq!((&verified["sampled"], &verified["differ"]), (&json!(32), &json!(0)), "{verified}");
}

/// Sections and files are of the number type and of the cells of their view.
#[test]
fn a_deep_view_is_of_one_number_type_and_one_grid() {
    let server = Server::start(&[]);
    let mut scene = flat();
    scene["omega"] = "4:4.01".into();
    scene["t_max"] = "3".into();
    let request = json!({ "scene": scene, "count": [200, 3] });
    let frames = server.post("map", &request).frames();
    let (last, _) = frames.last().unwrap();
    assert_eq!(last["precision"], "f64");
    let told = server.post("command", &request).json();
    let command = told["command"].as_str().unwrap();
    let [columns, rows] = [0, 1].map(|k| last["shape"][k].as_u64().unwrap());
    assert!(
        command.contains(&format!("--omega=4:4.01:{columns} --a-h=0.1:15:{rows}")),
        "{command}"
    );
    assert!(command.ends_with("--precision=f64"), "{command}");
    let line = json!({ "scene": scene, "from": [4, 1], "to": [4.01, 1], "count": 9 });
    assert_eq!(server.post("section", &line).json()["precision"], "f64");
    let line = json!({ "scene": scene, "from": [4, 1], "to": [4, 9], "count": 9 });
    assert_eq!(server.post("section", &line).json()["precision"], "f64");
}

/// A section along one of two axes that were named, and a map along whole numbers.
#[test]
fn any_two_numbers_are_axes() {
    let server = Server::start(&[]);
    let mut scene = flat();
    for (key, text) in
        [("omega", "4"), ("a_h", "5"), ("t_h", "0.8:3"), ("t_v", "0.3:1"), ("t_max", "5")]
    {
        scene[key] = text.into();
    }
    scene["x"] = "t_h".into();
    scene["y"] = "t_v".into();
    let line = json!({ "scene": scene, "from": [1, 0.5], "to": [2.5, 0.5], "count": 9 });
    assert_eq!(server.post("section", &line).json()["outcome"].as_array().unwrap().len(), 9);
    scene["t_v"] = "0.5".into();
    scene["bouc_wen_n"] = "1:4".into();
    scene["y"] = "bouc_wen_n".into();
    let frames = server.post("map", &json!({ "scene": scene, "count": [130, 4] })).frames();
    assert_eq!(frames.last().unwrap().0["shape"], json!([130, 4]), "{}", frames[0].0);
}

#[test]
fn files_are_those_of_a_map() {
    let server = Server::start(&[]);
    for (kind, begins) in [
        ("png", &b"\x89PNG"[..]),
        ("svg", b"<svg"),
        ("npz", b"PK"),
        ("csv", b"omega,a_h,"),
        ("toml", b"[pulse]"),
    ] {
        let answer =
            server.post("save", &json!({ "scene": flat(), "count": [9, 9], "kind": kind }));
        assert_eq!(answer.status, 200, "{kind}");
        assert!(answer.body.starts_with(begins), "{kind}: {:?}", &answer.body[..16]);
    }
}

#[test]
fn what_is_wrong_is_one_line_with_its_key() {
    let server = Server::start(&[]);
    for (key, text) in [
        ("t_h", "-1"),
        ("t_h", "0.5:4"),
        ("omega", "5"),
        ("isolation", "both"),
        ("horizontal", "../../etc/passwd"),
        ("psi", "2"),
        ("nothing", "1"),
    ] {
        let mut scene = flat();
        scene[key] = text.into();
        let request = json!({ "scene": scene, "count": [9, 9] });
        let frames = server.post("map", &request).frames();
        let error = &frames[0].0["error"];
        assert!(error["line"].as_str().is_some_and(|line| !line.contains('\n')), "{error}");
        assert_eq!(error["key"], key, "{error}");
        let answer = server.post("command", &request);
        assert!(answer.headers.contains(REFUSED), "{}", answer.headers);
        let told: Value = serde_json::from_slice(&answer.body).unwrap();
        assert_eq!(told["key"], key, "{told}");
    }
    for body in [json!({}), json!([1]), json!({ "scene": 1, "count": [9, 9] })] {
        assert!(server.post("map", &body).headers.contains(REFUSED), "{body}");
    }
}

#[test]
fn a_dropped_record_shakes_the_base() {
    let server = Server::start(&[]);
    let samples: Vec<String> =
        (0..400).map(|k| format!("{}", 4.0 * (f64::from(k) * 0.05).sin())).collect();
    let file = samples.join("\n");
    // A column of numbers tells neither its step nor its units.
    let body = dropped("a/one.txt", &file);
    let told = server.post_bytes("record", &body).json();
    assert_eq!(told["needs"], json!(["dt", "units"]), "{told}");
    let no_record = server.post_bytes("record", &dropped("a/one.txt", "no numbers at all"));
    assert!(no_record.headers.contains(REFUSED), "{}", no_record.headers);
    let cut = server.post_bytes("record", &body[..body.len() - 1]);
    assert!(String::from_utf8_lossy(&cut.body).contains("did not arrive whole"));
    let mut scene = json!({
        "object": "1", "horizontal": "one.txt", "dt": "0.01", "units": "m/s2",
        "t_h": "0.5:4", "t_v": "0.1:2", "x": "t_h", "y": "t_v",
    });
    let frames = server.post("map", &json!({ "scene": scene, "count": [17, 17] })).frames();
    assert_eq!(frames[0].0["shape"], json!([17, 17]), "{}", frames[0].0);
    let told = server.post("command", &json!({ "scene": scene, "count": [17, 17] })).json();
    assert!(told["command"].as_str().unwrap().contains("--horizontal=one.txt --dt=0.01"), "{told}");
    scene["horizontal"] = "synthetic".into();
    for key in ["dt", "units"] {
        scene.as_object_mut().unwrap().remove(key);
    }
    let frames = server.post("map", &json!({ "scene": scene, "count": [17, 17] })).frames();
    assert_eq!(frames[0].0["stage"], "coarse", "{}", frames[0].0);
}

/// The command writes a page, and leaves a folder of other files as it is.
#[test]
fn the_command_exports_a_page() {
    let room = Room::new();
    room.run("explore --backend cpu --export ./page");
    assert!(room.read("page/index.html").contains(r#"content="webgpu""#));
    let said = room.ended("explore --backend cpu --export ./");
    assert!(said.code == 2 && said.err.contains("holds other files"), "{said:?}");
    assert!(said.err.contains("--export"), "{said:?}");
}
