//! Arbitrary bytes and damaged objects in place of the object of a key: the store serves only the bytes that were
//! written.

use std::cell::RefCell;
use std::sync::Arc;

use bytes::Bytes;
use object_store::memory::InMemory;
use object_store::path::Path;
use object_store::{ObjectStore, ObjectStoreExt};
use tokio::runtime::Runtime;
use verne_store::{Key, Store};

use crate::draw::Draw;

thread_local! {
    static RUNTIME: RefCell<Runtime> =
        RefCell::new(tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap());
}

/// Bytes of the memory cache: none, so that each request reads the object.
const NO_MEMORY: u64 = 0;

/// Reads arbitrary bytes as an object.
pub(crate) fn store(bytes: &[u8]) {
    RUNTIME.with_borrow(|runtime| runtime.block_on(read(Draw::new(bytes))));
}

async fn read(mut draw: Draw<'_>) {
    let key = Key::from([draw.below(3).try_into().unwrap(); 32]);
    let digits = key.to_string();
    let place = Path::from_iter([&digits[..2], &digits[2..]]);
    let content = Bytes::from(vec![draw.byte(); draw.pick(&[0, 1, 100, 1000])]);
    let intact = object(key, &content, &place).await;
    let stored = if draw.one_in(4) { draw.rest().to_vec() } else { damaged(&mut draw, &intact) };
    let objects = Arc::new(InMemory::new());
    objects.put(&place, stored.clone().into()).await.unwrap();
    let store =
        Store::open_shared_over(Arc::clone(&objects) as Arc<dyn ObjectStore>, NO_MEMORY).await.unwrap();
    let same = stored == intact;
    let found = store.get(&key).await.map(|content| content.bytes);
    assert_eq!(found, same.then_some(content));
    assert!(
        same || objects.head(&place).await.is_err() || store.stats().read_failures > 0,
        "damage is removed"
    );
}

/// The object of a content, as the store writes it.
async fn object(key: Key, content: &Bytes, place: &Path) -> Vec<u8> {
    let objects = Arc::new(InMemory::new());
    let store =
        Store::open_shared_over(Arc::clone(&objects) as Arc<dyn ObjectStore>, NO_MEMORY).await.unwrap();
    store.put(&key, content.clone()).await;
    objects.get(place).await.unwrap().bytes().await.unwrap().to_vec()
}

/// An object with some bytes changed, removed or added.
fn damaged(draw: &mut Draw<'_>, intact: &[u8]) -> Vec<u8> {
    let mut object = intact.to_vec();
    for _ in 0..draw.below(4) {
        let at = (draw.below(256) * 256 + draw.below(256)) % object.len().max(1);
        match draw.below(6) {
            0..3 if at < object.len() => object[at] ^= draw.byte(),
            3 => object.truncate(at),
            4 => object.extend(draw.some_bytes()),
            // The stated length.
            _ if object.len() > 20 => {
                object[12..20].copy_from_slice(&draw.number(1e9).to_bits().to_le_bytes());
            }
            _ => {}
        }
    }
    object
}
