//! A shared library with the functions of include/hairline.h, and what it says of itself.

use super::super::PROTOCOL;
use super::super::asked::Form;
use super::guard::CurrentException;
use libloading::os::unix;
use std::ffi::{CStr, c_char, c_void};
use std::mem::ManuallyDrop;
use std::path::Path;

/// The version of include/hairline.h.
const ABI: u32 = 1;

/// `hairline_epsilon`.
#[repr(C)]
struct CEpsilon {
    name: *const c_char,
    value: *const c_char,
    refuses: *const c_char,
    length: i32,
    direction: i32,
    non_negative: i32,
    reserved: i32,
}

/// `hairline_kernel`.
#[repr(C)]
struct CKernel {
    name: *const c_char,
    source: *const c_char,
    contract: *const c_char,
    gives: u32,
    epsilon_count: u32,
    epsilons: *const CEpsilon,
}

/// `hairline_test_f32` and the others: cases, count, epsilons, verdicts.
pub(super) type TestFunction =
    unsafe extern "C-unwind" fn(*const c_void, usize, *const c_void, *mut c_void);

/// A loaded library; it stays loaded until the process ends.
pub(super) struct Library<'a> {
    library: ManuallyDrop<unix::Library>,
    /// How cases go to it.
    pub form: &'a Form,
    pub f32: Option<TestFunction>,
    pub f64: Option<TestFunction>,
}

impl<'a> Library<'a> {
    pub fn open(path: &Path, form: &'a Form) -> Result<Library<'a>, String> {
        // SAFETY: what the library's constructors do is what this process is for.
        let opened = unsafe { unix::Library::open(Some(path), unix::RTLD_NOW | unix::RTLD_LOCAL) };
        let library = ManuallyDrop::new(opened.map_err(|error| {
            // What the loader says stands in the source of the error.
            let reason = std::error::Error::source(&error).map(ToString::to_string);
            one_line(&reason.unwrap_or_else(|| error.to_string()))
        })?);
        let mut library = Library {
            library,
            form,
            f32: None,
            f64: None,
        };
        // SAFETY: by include/hairline.h this symbol has this type.
        let abi = unsafe { library.symbol::<unsafe extern "C" fn() -> u32>("hairline_abi") };
        let abi = abi.ok_or(
            "it has no function hairline_abi: build it with include/hairline.h (extern \"C\" in C++)",
        )?;
        // SAFETY: it takes nothing.
        let abi = unsafe { abi() };
        if abi != ABI {
            return Err(format!(
                "it was built with version {abi} of hairline.h, this program has version {ABI}"
            ));
        }
        // SAFETY: by include/hairline.h these symbols have this type.
        unsafe {
            library.f32 = library.symbol::<TestFunction>(form.functions[0]);
            library.f64 = library.symbol::<TestFunction>(form.functions[1]);
        }
        if library.f32.is_none() && library.f64.is_none() {
            return Err(format!("it has neither {}", form.functions.join(" nor ")));
        }
        Ok(library)
    }

    /// How to ask the library's C++ runtime for the exception that is being handled, if it has one.
    pub fn current_exception(&self) -> Option<CurrentException> {
        // SAFETY: by the Itanium C++ ABI (2.5.4) this symbol has this type.
        unsafe { self.symbol::<CurrentException>("__cxa_current_exception_type") }
    }

    /// A function of the library.
    ///
    /// # Safety
    /// The symbol is a function of type `T`, if there is one.
    unsafe fn symbol<T: Copy>(&self, name: &str) -> Option<T> {
        // SAFETY: the caller's promise.
        let symbol = unsafe { self.library.get::<T>(name.as_bytes()) };
        symbol.ok().map(|symbol| *symbol)
    }

    /// The library's description of itself, as the lines of a hello.
    pub fn hello(&self) -> Result<String, String> {
        // SAFETY: by include/hairline.h the symbol has this type, and what it returns stays valid.
        let kernel = unsafe {
            let describe =
                self.symbol::<unsafe extern "C" fn() -> *const CKernel>("hairline_describe");
            let describe = describe.ok_or("it has no function hairline_describe")?;
            describe()
                .as_ref()
                .ok_or("hairline_describe returned NULL")?
        };
        // SAFETY: strings by include/hairline.h.
        let [name, source, contract] =
            unsafe { [kernel.name, kernel.source, kernel.contract].map(|text| text_of(text)) };
        let mut hello = format!("hairline-kernel {PROTOCOL}\nencoding binary\n");
        hello += &format!("judges {}\n", self.form.judges);
        hello += &format!("name {}\n", name.ok_or("its name is NULL")?);
        hello += &format!("contract {}\n", contract.ok_or("its contract is NULL")?);
        hello += &source.map_or_else(String::new, |source| format!("source {source}\n"));
        if 7 < kernel.gives {
            return Err(format!(
                "its gives is {}, expected HAIRLINE_GIVES_T (1), HAIRLINE_GIVES_UV (2), HAIRLINE_GIVES_FACING (4), \
                 or a sum of them",
                kernel.gives
            ));
        }
        let words = |words: &[(bool, &str)]| -> String {
            words
                .iter()
                .filter(|(given, _)| *given)
                .map(|(_, word)| format!(" {word}"))
                .collect()
        };
        let gives =
            [(1, "t"), (2, "uv"), (4, "facing")].map(|(bit, w)| (kernel.gives & bit != 0, w));
        hello += &format!("gives{}\n", words(&gives));
        let scalars = [(self.f32.is_some(), "f32"), (self.f64.is_some(), "f64")];
        hello += &format!("scalars{}\n", words(&scalars));
        // SAFETY: by include/hairline.h this symbol has this type, and takes nothing.
        let processes = unsafe {
            let processes = self.symbol::<unsafe extern "C" fn() -> u32>("hairline_processes");
            processes.map(|processes| processes())
        };
        hello += &processes.map_or_else(String::new, |number| format!("processes {number}\n"));
        if kernel.epsilon_count > 0 && kernel.epsilons.is_null() {
            return Err("its epsilons are NULL, and epsilon_count is not 0".to_owned());
        }
        for i in 0..kernel.epsilon_count as usize {
            // SAFETY: epsilon_count elements by include/hairline.h.
            hello += &epsilon_line(unsafe { &*kernel.epsilons.add(i) })?;
        }
        Ok(hello)
    }
}

fn epsilon_line(epsilon: &CEpsilon) -> Result<String, String> {
    // SAFETY: strings by include/hairline.h.
    let [name, value, refuses] =
        unsafe { [epsilon.name, epsilon.value, epsilon.refuses].map(|text| text_of(text)) };
    let name = name.ok_or("an epsilon's name is NULL")?;
    let value = value.ok_or_else(|| format!("the value of epsilon {name} is NULL"))?;
    let sign = if epsilon.non_negative != 0 {
        "non-negative"
    } else {
        "signed"
    };
    let (length, direction) = (epsilon.length, epsilon.direction);
    let refuses = refuses.unwrap_or_default();
    Ok(format!(
        "epsilon {name} {value} {length} {direction} {sign} {refuses}\n"
    ))
}

/// A C string on one line; none for NULL.
///
/// # Safety
/// `text` is NULL or a valid C string.
unsafe fn text_of(text: *const c_char) -> Option<String> {
    // SAFETY: the caller's promise.
    let text = (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) })?;
    Some(one_line(&text.to_string_lossy()))
}

/// A text without line ends.
pub(super) fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}
