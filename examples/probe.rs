use topple::{scene::{*,text::SceneText}, sweep::{cells::Plan,cpu}};
fn main(){
  let step: f64 = std::env::args().nth(1).unwrap().parse().unwrap();
  let step2:f64=std::env::args().nth(2).map_or(0.0,|s|s.parse().unwrap());
  let mut r = csv::Reader::from_path("tests/data/reference-cells.csv").unwrap();
  for rec in r.records(){ let rec=rec.unwrap();
    let f=|i:usize| rec[i].to_string();
    let t=format!("[block]\nobject={}\neccentricity={}\n[base]\nt_h={}\nt_v={}\n[pulse]\na_v={}\nomega={}\na_h={}\n",f(0),f(1),f(2),f(3),f(4),f(5),f(6));
    let s=SceneText::from_toml(&t).unwrap().check().unwrap();
    let p=Plan::new(&s,step).unwrap(); let g=Grid::of(&s);
    let o=cpu::sweep::<f64>(&p,&g,0..1,&|_|())[0]; let q=cpu::sweep::<f32>(&p,&g,0..1,&|_|())[0];
    let st=topple::integrate::reference::Settings{tolerance:step2,..Default::default()}; let q=if step2>0.0{topple::integrate::reference::run(&s,&g.point(0),&st)}else{q};
    let te:f64=f(9).parse().unwrap(); let z:f64=f(11).parse().unwrap(); let tu:f64=f(10).parse().unwrap_or(0.0);
    println!("{:16} {:16} {:16} {:>3} {:>5} {:>5} dt {:+.1e} {:+.1e} dz {:+.1e} {:+.1e} tu {:+.1e} {}",f(7),o.class.name(),q.class.name(),f(8),o.impacts,q.impacts,o.t_end-te,q.t_end-te,o.zeta-z,q.zeta-z,o.t_uplift.unwrap_or(0.0)-tu, if o.class.name()!=f(7)||q.class.name()!=f(7) {"<<<<"} else {""});
  }
}
