//! temp
use verne_solver::Machine;
use verne_solver::workspace::*;
#[test]
fn figures() {
    let m = Machine::verne();
    let mut mm = m.data().clone(); mm.geometry.rod_radius = 60.0; let thick = Machine::new(mm.clone()).unwrap();
    mm.geometry.rod_radius=25.0; mm.limits.stroke=[[100.0,400.0];3]; let short = Machine::new(mm).unwrap();
    for (m, kind, l, phi1) in [(&m, Kind::Platform,0.0,0.0),(&m,Kind::Tool,50.0,0.0),(&m,Kind::Tool,150.0,0.0),(&m,Kind::Tool,300.0,0.0),(&m,Kind::Part,50.0,0.0),(&m,Kind::Part,50.0,30.0),(&m,Kind::Part,50.0,60.0),(&thick,Kind::Platform,0.0,0.0),(&short,Kind::Platform,0.0,0.0)] {
        let r = Request{kind, tool_length:l, phi1: f64::to_radians(phi1), phi2:0.0, tolerance:1.0};
        let t = std::time::Instant::now();
        let v = measure(m,&r,&Unobserved).unwrap();
        let e = t.elapsed();
        println!("{kind:?} {l} {phi1} {v:?} {:?}", e);
    }
}
#[test]
fn brute() {
    use verne_solver::{platform_working, Margins};
    let m = Machine::verne();
    let mut mm=m.data().clone(); mm.geometry.rod_radius=60.0; let m=Machine::new(mm).unwrap(); let n=2400; let (x0,x1,y0,y1)=(-420.0,400.0,-560.0,560.0);
    let mut area=0.0; let mut vol=0.0;
    for i in 0..n { for j in 0..n {
        let x=x0+(x1-x0)*(i as f64+(j as f64*0.7548776662466927).fract())/n as f64; let y=y0+(y1-y0)*(j as f64+(i as f64*0.6180339887498949).fract())/n as f64;
        let Ok(p)=platform_working(&m,[x,y,1000.0]) else {continue};
        let mut g=Margins::of(&m,&p,None); g.stroke=[[1.0;2];3];
        if !g.feasible() {continue}
        let (mut lo,mut hi)=(f64::MIN,f64::MAX);
        for k in 0..3 { let f=1000.0-p.rho[k]; let s=m.data().limits.stroke[k]; lo=lo.max(s[0]+f); hi=hi.min(s[1]+f); }
        if hi>lo { area+=1.0; vol+=hi-lo; }
    }}
    let c=(x1-x0)*(y1-y0)/(n*n) as f64;
    println!("brute {} {}", area*c, vol*c);
}
