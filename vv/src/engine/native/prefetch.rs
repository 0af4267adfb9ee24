//! Prefetches, for which Cranelift has no instruction: loads of one byte are made into them.

/// Makes the load at an offset of machine code a prefetch, if it is one.
///
/// Both are written alike on x86-64: perhaps a REX prefix, two bytes of opcode of which the second tells them apart, then a
/// register and the address. The register of a prefetch says which, 1 is that into all caches.
pub(super) fn put(code: &mut [u8], at: usize) -> Option<()> {
    const REX: u8 = 0x40;
    const REGISTER_OF_REX: u8 = 0b0100;
    const REGISTER: u8 = 0b0011_1000;
    let first = code.get_mut(at)?;
    let has_rex = *first & 0xf0 == REX;
    let load = at + usize::from(has_rex);
    if let [0x0f, opcode @ 0xb6, register, ..] = code.get_mut(load..)? {
        *opcode = 0x18;
        *register = *register & !REGISTER | 1 << 3;
    } else {
        return None;
    }
    if has_rex {
        code[at] &= !REGISTER_OF_REX;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    #[track_caller]
    fn check(load: &[u8], expected: Option<&[u8]>) {
        let mut code = [&[0x90], load, &[0x90]].concat();
        let put = super::put(&mut code, 1);
        assert_eq!(put.map(|()| &code[1..code.len() - 1]), expected);
    }

    #[test]
    fn a_load_of_a_byte_becomes_a_prefetch_of_the_same_address() {
        // movzx eax, byte [rdi + rsi * 4] becomes prefetcht0 [rdi + rsi * 4]
        check(&[0x0f, 0xb6, 0x04, 0xb7], Some(&[0x0f, 0x18, 0x0c, 0xb7]));
        // movzx r15d, byte [r10 + r11 - 12] becomes prefetcht0 [r10 + r11 - 12]
        check(&[0x47, 0x0f, 0xb6, 0x7c, 0x1a, 0xf4], Some(&[0x43, 0x0f, 0x18, 0x4c, 0x1a, 0xf4]));
    }

    #[test]
    fn what_is_no_load_of_a_byte_stays() {
        // mov eax, [rdi]
        check(&[0x8b, 0x07], None);
        // movsx eax, byte [rdi]
        check(&[0x40, 0x0f, 0xbe, 0x07], None);
    }
}
