//! temp
use verne_solver::Machine;
use verne_solver::workspace::*;
use std::collections::HashMap;
fn edges(s:&Surface)->(usize,usize,i64){ let mut m:HashMap<(u32,u32),i32>=HashMap::new();
 for t in &s.triangles { for i in 0..3 { *m.entry((t[i],t[(i+1)%3])).or_default()+=1; } }
 let bad=m.iter().filter(|((a,b),n)| **n!=1 || m.get(&(*b,*a))!=Some(&1)).count();
 let used:std::collections::HashSet<u32>=s.triangles.iter().flatten().copied().collect();
 let chi=used.len() as i64-(m.len()/2) as i64+s.triangles.len() as i64;
 (bad,m.len()/2,chi)
}
#[test]
fn figures() {
    let m = Machine::verne();
    let mut mm = m.data().clone(); mm.geometry.rod_radius = 60.0; let thick = Machine::new(mm.clone()).unwrap();
    mm.geometry.rod_radius=25.0; mm.limits.stroke=[[100.0,400.0];3]; let short = Machine::new(mm.clone()).unwrap();
    for tol in [10.0,3.0,1.0,0.3] {
    for (m, kind, l, phi1) in [(&m, Kind::Platform,0.0f64,0.0),(&m,Kind::Tool,150.0,0.0),(&m,Kind::Part,50.0,0.0),(&m,Kind::Part,50.0,60.0),(&thick,Kind::Platform,0.0,0.0),(&short,Kind::Platform,0.0,0.0)] {
        let r = Request{kind, tool_length:l, phi1: f64::to_radians(phi1), phi2:0.0, tolerance:tol};
        let v = measure(m,&r,&Unobserved).unwrap();
        let t = std::time::Instant::now();
        let s = surface(m,&r,&Unobserved).unwrap();
        let e = t.elapsed();
        let Volume::Value{value,..}=v.volume else {panic!()};
        let len=|p:[f64;3],q:[f64;3]| ((p[0]-q[0]).powi(2)+(p[1]-q[1]).powi(2)+(p[2]-q[2]).powi(2)).sqrt();
        let shortest=s.triangles.iter().flat_map(|t| (0..3).map(|i| len(s.positions[t[i] as usize],s.positions[t[(i+1)%3] as usize])).collect::<Vec<_>>()).fold(f64::MAX,f64::min);
        println!("{tol} {kind:?} {l} {phi1}: {} tri {} vert, vol rel {:.2e}, edges {:?}, shortest {shortest:.1e}, {:?} {:?}", s.triangles.len(), s.positions.len(), s.volume()/value-1.0, edges(&s), e, s.bounds());
    }}
}
struct Rng(u64);
impl Rng { fn f(&mut self)->f64{ self.0^=self.0<<13; self.0^=self.0>>7; self.0^=self.0<<17; (self.0>>11) as f64/(1u64<<53) as f64 } fn r(&mut self,a:f64,b:f64)->f64{a+(b-a)*self.f()} }
#[test]
fn fuzz() {
    let mut g=Rng(88172645463325252); let mut bad=0; let mut n=0; let mut empties=0; let mut kinds=HashMap::new(); let mut worst:Vec<(f64,String)>=vec![];
    for case in 0..std::env::var("CASES").ok().and_then(|s| s.parse().ok()).unwrap_or(300) {
        let mut d=Machine::verne().data().clone();
        let o=&mut d.geometry;
        if g.f()<0.7 { o.L1*=g.r(0.8,1.3); o.L2*=g.r(0.8,1.3); o.L3= if g.f()<0.5 {o.L2} else {o.L3*g.r(0.8,1.3)}; o.R1*=g.r(0.7,1.5); o.r1*=g.r(0.5,1.5); o.R2*=g.r(0.6,2.0); o.r4*=g.r(0.6,1.3); o.d1*=g.r(0.6,1.2); o.d2*=g.r(0.6,1.2);}
        o.rod_radius=g.r(0.0,70.0);
        for s in &mut d.limits.stroke { if g.f()<0.6 { s[0]=g.r(0.0,200.0); s[1]=s[0]+g.r(100.0,700.0);} }
        if g.f()<0.5 { d.limits.slider_cone=g.r(0.3,1.5); d.limits.platform_cone=g.r(0.3,1.5); }
        if g.f()<0.4 { d.limits.serial_margin=g.r(0.0,0.6); d.limits.parallel_margin=g.r(0.0,0.1);}
        if g.f()<0.4 { d.limits.tilt=[g.r(-0.6,0.0),g.r(0.05,0.6)]; }
        let Ok(m)=Machine::new(d.clone()) else {continue};
        let kind=[Kind::Platform,Kind::Tool,Kind::Part][(g.f()*3.0) as usize];
        let r=Request{kind,tool_length:g.r(-100.0,300.0),phi1:g.r(-0.7,0.7),phi2:g.r(-3.0,3.0),tolerance:[20.0,5.0,1.0][(g.f()*3.0) as usize]};
        let v=measure(&m,&r,&Unobserved).unwrap();
        if std::env::var("SHOW").is_ok() { println!("at {case} {r:?} {:?}",m.data()); }
        let s=surface(&m,&r,&Unobserved).unwrap();
        let (b,_,chi)=edges(&s); n+=1;
        if s.triangles.is_empty() {empties+=1;}
        *kinds.entry(chi).or_insert(0)+=1;
        if std::env::var("BRUTE").ok().and_then(|s| s.parse::<usize>().ok())==Some(case) {
            let n=1000; let (mut area,mut vol)=(0.0,0.0); let bb=s.bounds().unwrap();
            for i in 0..n { let mut row=0.0; for j in 0..n {
                let x=bb[0][0]+(bb[1][0]-bb[0][0])*(i as f64+0.5)/n as f64; let y=bb[0][1]+(bb[1][1]-bb[0][1])*(j as f64+0.5)/n as f64;
                let Ok(p)=verne_solver::platform_working(&m,[x,y,1000.0]) else {continue};
                let mut g=verne_solver::Margins::of(&m,&p,None); g.stroke=[[1.0;2];3]; if !g.feasible() {continue}
                let (mut lo,mut hi)=(f64::MIN,f64::MAX);
                for k in 0..3 { let f=1000.0-p.rho[k]; let s=m.data().limits.stroke[k]; lo=lo.max(s[0]+f); hi=hi.min(s[1]+f); }
                if hi>lo { area+=1.0; vol+=hi-lo; row+=1.0;} }
                if i%20==10 { println!("row {i} x {} len {}", bb[0][0]+(bb[1][0]-bb[0][0])*(i as f64+0.5)/n as f64, row*(bb[1][1]-bb[0][1])/n as f64);} }
            let c=(bb[1][0]-bb[0][0])*(bb[1][1]-bb[0][1])/(n*n) as f64;
            println!("brute area {} vol {} measured {v:?} bounds {bb:?} {:?}", area*c, vol*c, m.data());
        }
        if b>0 && std::env::var("EDGES").is_ok() { let mut m:HashMap<(u32,u32),i32>=HashMap::new();
 for t in &s.triangles { for i in 0..3 { *m.entry((t[i],t[(i+1)%3])).or_default()+=1; } }
 for ((a,b),n) in &m { if *n!=1 || m.get(&(*b,*a))!=Some(&1) { println!("edge {a} {b} x{n} {:?} {:?}", s.positions[*a as usize], s.positions[*b as usize]);
   for (t,bd) in s.triangles.iter().zip(&s.bindings) { if t.contains(a)&&t.contains(b) { println!("   {t:?} {bd:?}"); } } } } }
        if b>0 { bad+=1; println!("case {case} {kind:?} tol {} bad {b} chi {chi} tri {}", r.tolerance, s.triangles.len()); }
        match v.volume { Volume::Value{value,error} => { if error>1e-6*value { println!("case {case} {kind:?} volume {value} error {:.2e} area err {:.1e}", error/value, v.area_error/v.area); }
            let off=(s.volume()-value)/(v.area.max(1.0)+1.0)/r.tolerance; worst.push((off.abs(),format!("case {case} {kind:?} tol {} vol {value} mesh {} off/tol {off} area {}",r.tolerance,s.volume(),v.area))); }
            Volume::Folded => println!("case {case} folded {:?}", v.jacobian) }
    }
    worst.sort_by(|a,b| b.0.total_cmp(&a.0)); for w in worst.iter().take(8) { println!("{}",w.1); }
    println!("{n} machines, {empties} empty, {bad} bad, chi {kinds:?}");
}
