//! Scratch.
#![allow(
    unsafe_code,
    missing_docs,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::allow_attributes,
    clippy::allow_attributes_without_reason
)]
use std::sync::Arc;
use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions, read};

fn usage() -> (f64, f64, i64, i64) {
    let mut u: libc::rusage = unsafe { std::mem::zeroed() };
    unsafe { libc::getrusage(libc::RUSAGE_THREAD, &mut u) };
    let ms = |t: libc::timeval| t.tv_sec as f64 * 1e3 + t.tv_usec as f64 / 1e3;
    (ms(u.ru_utime), ms(u.ru_stime), u.ru_minflt, u.ru_maxrss)
}
fn cpu() -> f64 {
    let mut t = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut t) };
    t.tv_sec as f64 * 1e3 + t.tv_nsec as f64 / 1e6
}

fn main() {
    let a: Vec<String> = std::env::args().collect();
    let reps: usize = a[3].parse().unwrap();
    if std::env::var("NOKEEP").is_err() {
        vv::engine::keep_freed_memory();
    }
    let text = std::fs::read_to_string(&a[1]).unwrap();
    let folder = std::path::Path::new("assets/programs");
    let mut include = |_: &str, name: &str| {
        let text = std::fs::read_to_string(folder.join(name)).map_err(|e| e.to_string())?;
        Ok(vv::Included { name: name.to_owned(), text })
    };
    let c = vv::compile("program.vv", &text, &mut include);
    let program = c.program.expect("program");
    let rule = program.default_rule().unwrap();
    let machine = Machine::new(Arc::clone(&program), Engine::Native);
    let format = if a[2].ends_with(".off") { Format::Off } else { Format::Obj };
    let mesh = read(&std::fs::read(&a[2]).unwrap(), format, &ReadOptions::default()).unwrap().0;
    if std::env::var("MIXED").is_ok() {
        unsafe {
            libc::mallopt(libc::M_MMAP_MAX, 65536);
            libc::mallopt(libc::M_MMAP_THRESHOLD, 32 << 20);
        }
    }
    if let Ok(path) = std::env::var("DUMP") {
        let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
        for line in maps.lines() {
            let f: Vec<&str> = line.split_whitespace().collect();
            if f[1] == "r-xp" && f.len() == 5 {
                let (s, e) = f[0].split_once('-').unwrap();
                let (s, e) = (usize::from_str_radix(s, 16).unwrap(), usize::from_str_radix(e, 16).unwrap());
                let bytes = unsafe { std::slice::from_raw_parts(s as *const u8, e - s) };
                std::fs::write(format!("{path}.{s:x}.bin"), bytes).unwrap();
            }
        }
    }
    for _ in 0..reps {
        let (u, s, f, r) = usage();
        let c = cpu();
        let wall = std::time::Instant::now();
        let new = machine.run(rule, &mesh, 1, &Settings::default(), &mut Vec::new()).unwrap();
        let w = wall.elapsed().as_secs_f64() * 1e3;
        let c = cpu() - c;
        let (u2, s2, f2, r2) = usage();
        println!(
            "{w:.2} {c:.2} {:.1} {:.1} {} {:.0} {:.0} {}",
            u2 - u,
            s2 - s,
            f2 - f,
            r as f64 / 1024.0,
            r2 as f64 / 1024.0,
            new.vertex_count()
        );
    }
}
