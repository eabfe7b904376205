use topple::scene::{Directions, Parameter, SceneBuilder, Values};
use topple_studies::comparison::devices::read;

fn shared() -> SceneBuilder {
    SceneBuilder::object(1).with(Parameter::XiV, 0.2).with(Parameter::UY, 0.01)
}

#[test]
fn a_device_is_what_all_share_with_what_it_has_of_its_own() {
    let text = "device,t_h,isolation,XI-V,object\n\"soft, old\",2.5,dual,,\nnone,,none,0.1,2\nrigid,,none,,\n";
    let devices = read(text, &shared()).unwrap();
    let [soft, none, rigid] = &devices[..] else { panic!("{devices:?}") };
    assert_eq!((soft.name.as_str(), soft.line), ("soft, old", 2));
    let number = |device: &topple_studies::comparison::devices::Device, parameter| {
        device.scene.numbers.get(parameter).and_then(Values::single)
    };
    assert_eq!(number(soft, Parameter::TH), Some(2.5));
    assert_eq!(number(soft, Parameter::XiV), Some(0.2));
    assert_eq!(number(soft, Parameter::UY), Some(0.01));
    assert_eq!((soft.scene.object, soft.scene.isolation), (Some(1), Some(Directions::Dual)));
    assert_eq!((none.scene.object, none.scene.isolation), (Some(2), Some(Directions::None)));
    assert_eq!((number(none, Parameter::TH), number(none, Parameter::XiV)), (None, Some(0.1)));
    // What all share means nothing of a base that does not move; its own stays, to be refused.
    assert_eq!((number(rigid, Parameter::XiV), number(rigid, Parameter::UY)), (None, None));
    assert!(rigid.left_out.contains(&Parameter::XiV) && rigid.left_out.contains(&Parameter::UY));
    assert_eq!((&soft.left_out[..], &none.left_out[..]), (&[][..], &[Parameter::UY][..]));
}

#[test]
fn a_name_is_one_line() {
    let devices = read("device,t_h\n\"A\nB\u{1b}[2J\",1\n", &shared()).unwrap();
    assert_eq!(devices[0].name, "A B[2J");
    let error = read("device,t_h\n\"A\nB\",1\nA B,2\n", &shared()).unwrap_err().to_string();
    assert!(error.contains("the name A B stands in line 2, too"), "{error}");
}

#[test]
fn what_spreadsheets_save_is_read() {
    let text = "\u{feff}sep=;\r\ndevice;t_h\r\n\r\na;1,5\r\nb;2\r\n";
    let devices = read(text, &shared()).unwrap();
    let t_h: Vec<f64> =
        devices.iter().map(|one| one.scene.numbers.get(Parameter::TH).unwrap().first()).collect();
    assert_eq!((t_h, devices[1].line), (vec![1.5, 2.0], 5));
    for (text, wanted) in [
        ("device,t_h,,\na,1.5,,\nb,2,,\n,,,\n", [1.5, 2.0]),
        ("device,t_h,,\na,1.5\nb,2,,,,\n", [1.5, 2.0]),
        (
            "#TYPE System.Object\n\"device\",\"t_h\"\n# stiff\n\"a\",\"1.5\"\n#c,3\n\"b\",\"2\"\n",
            [1.5, 2.0],
        ),
        ("device,,t_h\n\"#1\",,1.5\nb,,2.000\n", [1.5, 2.0]),
        ("device;t_h\na;1,5\nb;1,250\n", [1.5, 1.25]),
        ("device;t_h\na;1.5\nb;1.250\n", [1.5, 1.25]),
        ("device\tt_h\na\t1,5\nb\t1,250\n", [1.5, 1.25]),
    ] {
        let devices = read(text, &shared()).unwrap();
        let t_h = |at: usize| devices[at].scene.numbers.get(Parameter::TH).unwrap().first();
        assert_eq!((devices.len(), [t_h(0), t_h(1)]), (2, wanted), "{text:?}");
    }
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let refused = |text: &str| read(text, &shared()).unwrap_err().to_string();
    for (text, wanted) in [
        ("", "line 1: the list is empty; give a heading with `device`"),
        ("device,t_h\n", "line 1: no device below the heading"),
        ("name,t_h\na,1\n", "line 1, column name: no key has this name"),
        ("t_h,t_v\n1,1\n", "line 1: no column `device`"),
        ("device,t_h,t-h\na,1,1\n", "line 1, column t-h: it stands twice"),
        ("device,omega\na,1\n", "line 1, column omega: the motions of the suite shake"),
        ("device,dt\na,1\n", "line 1, column dt: the motions of the suite shake"),
        ("device,force\na,true\n", "line 1, column force: it is of the whole comparison"),
        ("device,t_h\na,1\na,2\n", "line 3, column device: the name a stands in line 2, too"),
        ("device,t_h\na,1\n\n,2\n", "line 4, column device: empty; give each device a name"),
        ("device,t_h\na,fast\n", "line 2, column t_h: 'fast' is no number such as"),
        ("device,t_h\na,1:2:3\n", "line 2, column t_h: '1:2:3' has several values"),
        ("device,t_h\na,nan\n", "line 2, column t_h: 'nan' is no number"),
        ("device,t_h\na\n", "line 2: 1 fields where the heading has 2"),
        ("device,t_h,,\na,1,,2\n", "line 2: '2' stands in a column without a name"),
        ("device,t_h\n#1,2\nb,2\n", "line 2: `#` begins a comment, and this one has the cells"),
        ("device,t_h\n\"a,2\nb,2\n", "line 2: a cell begins with a quote"),
        (
            "device,isolation\na,Horizontal\n",
            "line 2, column isolation: 'Horizontal' is not known; give one of dual, horizontal, vertical, none",
        ),
        ("device,isolation,t_h\n-,-,s\n", "line 2, column isolation: '-' is not known; give one"),
        (
            "device,pressure\na,on\n",
            "line 2, column pressure: 'on' is not known; give one of follows, constant",
        ),
        (
            "device,object\na,one\n",
            "line 2, column object: 'one' is not known; give one of 1, 2, 3",
        ),
        ("device,object\na,4\n", "line 2, column object: '4' is not known; give one of 1, 2, 3"),
        (
            "device,overturn\na,x\n",
            "line 2, column overturn: 'x' is not known; give one of critical-angle, quarter-turn",
        ),
        ("device,k1\na,\"200,000\"\n", "line 2, column k1: '200,000' may be 200000 or 200; write"),
        ("device\tk1\na\t1,250\n", "line 2, column k1: '1,250' may be 1250 or 1.25"),
        ("device\tk1\na\t1.250\n", "line 2, column k1: '1.250' may be 1250 or 1.25"),
        ("device;k1\na;200.000\n", "line 2, column k1: '200.000' may be 200000 or 200"),
        ("device;k1;t_h\na;200.000;1,5\n", "line 2, column k1: '200.000' may be"),
        ("device;k1;t_h\na;200,000;1.5\n", "line 2, column k1: '200,000' may be"),
        ("device,k1\na,1.250.000\n", "line 2, column k1: '1.250.000' is no number"),
        ("device,k1\na,200 000\n", "line 2, column k1: '200 000' is no number"),
    ] {
        let line = refused(text);
        assert!(line.starts_with(wanted) && !line.contains('\n'), "{text:?}: {line}");
    }
}
