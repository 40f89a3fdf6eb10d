//! The bytes behind accessors: from a GLB file, a data URI or a file beside it.

use super::super::ReadBeside;
use super::InputError;
use crate::json::quoted;
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::Accessor;
use gltf::buffer::{Buffer, Source, View};
use std::collections::HashMap;
use std::path::{Component, Path};

/// Padding is optional: exporters leave it away.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The buffers of a file, read when they are needed first.
pub(super) struct Buffers<'a> {
    name: &'a str,
    binary: Option<Vec<u8>>,
    beside: &'a mut ReadBeside<'a>,
    loaded: HashMap<usize, Vec<u8>>,
    /// Bytes read so far.
    bytes: usize,
}

impl<'a> Buffers<'a> {
    /// The buffers of a file of so many bytes.
    pub fn new(
        name: &'a str,
        binary: Option<Vec<u8>>,
        bytes: usize,
        beside: &'a mut ReadBeside<'a>,
    ) -> Buffers<'a> {
        Buffers {
            name,
            binary,
            beside,
            loaded: HashMap::new(),
            bytes,
        }
    }

    /// How many bytes were read so far.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// An accessor's elements without gaps.
    pub fn elements(&mut self, accessor: &Accessor) -> Result<Vec<u8>, InputError> {
        let (count, size, index) = (accessor.count(), accessor.size(), accessor.index());
        let name = self.name;
        let bad = |message: String| InputError::of(name, format!("accessors[{index}]: {message}"));
        let mut elements = match accessor.view() {
            Some(view) => self.packed(&view, accessor.offset(), count, size, index)?,
            None => Vec::new(),
        };
        let Some(sparse) = accessor.sparse() else {
            return Ok(elements);
        };
        let indices = sparse.indices();
        let [width, replaced] = [indices.index_type().size(), sparse.count()];
        let places = self.packed(&indices.view(), indices.offset(), replaced, width, index)?;
        let (view, offset) = (sparse.values().view(), sparse.values().offset());
        let values = self.packed(&view, offset, replaced, size, index)?;
        if accessor.view().is_none() {
            // All but the replaced are zero, and a small file must not ask for any memory.
            if count > self.bytes {
                let message = format!("{count} elements, more than the {} bytes read", self.bytes);
                return Err(bad(message));
            }
            elements = vec![0; count * size];
        }
        for (place, value) in places.chunks_exact(width).zip(values.chunks_exact(size)) {
            let mut number = [0; 4];
            number[..width].copy_from_slice(place);
            let place = u32::from_le_bytes(number) as usize;
            match elements.chunks_exact_mut(size).nth(place) {
                Some(element) => element.copy_from_slice(value),
                None => {
                    return Err(bad(format!(
                        "sparse index {place}, but it has {count} elements"
                    )));
                }
            }
        }
        Ok(elements)
    }

    fn packed(
        &mut self,
        view: &View,
        offset: usize,
        count: usize,
        size: usize,
        accessor: usize,
    ) -> Result<Vec<u8>, InputError> {
        let name = self.name;
        let buffer = self.buffer(&view.buffer())?;
        let stride = view.stride().unwrap_or(size);
        let held = || {
            let end = view.offset().checked_add(view.length())?;
            let bytes = buffer.get(view.offset()..end)?.get(offset..)?;
            let Some(last) = count.checked_sub(1) else {
                return Some(Vec::new());
            };
            let bytes = bytes.get(..last.checked_mul(stride)?.checked_add(size)?)?;
            let element = |i: usize| &bytes[i * stride..][..size];
            Some((0..count).flat_map(element).copied().collect())
        };
        held().ok_or_else(|| {
            let place = format!("accessors[{accessor}]: bufferViews[{}]", view.index());
            let message = format!("{place} does not hold {count} elements of {size} bytes");
            InputError::of(name, message)
        })
    }

    fn buffer(&mut self, buffer: &Buffer) -> Result<&[u8], InputError> {
        let index = buffer.index();
        if !self.loaded.contains_key(&index) {
            let bytes = self.load(buffer)?;
            if bytes.len() < buffer.length() {
                let (has, expected) = (bytes.len(), buffer.length());
                let message = format!("buffers[{index}] has {has} bytes, expected {expected}");
                return Err(InputError::of(self.name, message));
            }
            self.bytes = self.bytes.saturating_add(bytes.len());
            self.loaded.insert(index, bytes);
        }
        Ok(&self.loaded[&index])
    }

    fn load(&mut self, buffer: &Buffer) -> Result<Vec<u8>, InputError> {
        let place = format!("buffers[{}]", buffer.index());
        let bad = |message: &str| InputError::of(self.name, format!("{place}{message}"));
        let uri = match buffer.source() {
            Source::Bin if buffer.index() == 0 => {
                return self
                    .binary
                    .take()
                    .ok_or_else(|| bad(" has neither a uri nor a BIN chunk"));
            }
            Source::Bin => return Err(bad(" has no uri")),
            Source::Uri(uri) => uri,
        };
        if let Some(data) = uri.strip_prefix("data:") {
            let Some((_, text)) = data.split_once(";base64,") else {
                return Err(bad(".uri: a data URI that is not base64"));
            };
            let decoded = BASE64.decode(text);
            return decoded.map_err(|error| bad(&format!(".uri: not base64: {error}")));
        }
        let Some(path) = path_beside(uri) else {
            let uri = quoted(uri);
            return Err(bad(&format!(
                ".uri: {uri} is not a file in the folder of this one"
            )));
        };
        (self.beside)(&path, buffer.length() as u64).map_err(|error| {
            let place = format!("{place}.uri: {}", quoted(&path));
            let unread = InputError::reading(self.name, None, &error);
            InputError {
                message: format!("{place}: {}", unread.message),
                ..unread
            }
        })
    }
}

/// The relative path that a URI means, if it stays in its folder or below.
fn path_beside(uri: &str) -> Option<String> {
    if uri.contains([':', '\\']) {
        return None;
    }
    let mut bytes = Vec::new();
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        if byte == b'%' {
            let mut digit = || char::from(rest.next()?).to_digit(16);
            bytes.push((digit()? * 16 + digit()?) as u8);
        } else {
            bytes.push(byte);
        }
    }
    let path = String::from_utf8(bytes).ok()?;
    let mut parts = Path::new(&path).components().peekable();
    let inside = parts.peek().is_some()
        && parts.all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    (inside && !path.contains(['\\', '\0'])).then_some(path)
}
