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
