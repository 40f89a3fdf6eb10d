
#[doc(hidden)]
pub mod mutant {
    //! Which mutant is active; the mutation tool has added this module.
    use std::io::Write;
    use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

    const SITES: usize = 0;
    const UNREAD: u32 = u32::MAX;
    const LOGGING: u32 = u32::MAX - 1;
    static ACTIVE: AtomicU32 = AtomicU32::new(UNREAD);
    static REACHED: [AtomicBool; SITES] = [const { AtomicBool::new(false) }; SITES];

    /// The active mutant, 0 without one.
    #[inline(always)]
    pub fn at(site: u32) -> u32 {
        let active = ACTIVE.load(Relaxed);
        if active < LOGGING || REACHED[site as usize].load(Relaxed) { active } else { first(site) }
    }

    #[cold]
    #[inline(never)]
    fn first(site: u32) -> u32 {
        if ACTIVE.load(Relaxed) == UNREAD {
            let number = std::env::var("MUTANT").ok().and_then(|text| text.parse().ok());
            let otherwise = if std::env::var_os("MUTANT_LOG").is_some() { LOGGING } else { 0 };
            ACTIVE.store(number.unwrap_or(otherwise), Relaxed);
        }
        let active = ACTIVE.load(Relaxed);
        if active == LOGGING && !REACHED[site as usize].swap(true, Relaxed) {
            let path = std::env::var_os("MUTANT_LOG").expect("read above");
            let log = std::fs::OpenOptions::new().append(true).create(true).open(path);
            log.and_then(|mut log| log.write_all(format!("{site}\n").as_bytes())).expect("the log");
        }
        active
    }
}
